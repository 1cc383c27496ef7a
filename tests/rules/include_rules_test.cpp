// Reads every include of the project and holds it against the table of rooms, which it takes from
// ARCHITECTURE.md ("Rooms"). It does not prove that the rooms are well cut, only that the walls
// stand.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palace {
namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;  // relative to the root
  int line = 0;
  std::string path;  // as written
  bool system = false;
};

std::string RoomOf(const std::string& path) {
  std::smatch match;
  return std::regex_search(path, match, std::regex("^((?:engine|gui)/[a-z]+)/")) ? match[1].str()
                                                                                 : "";
}

std::vector<Include> ReadIncludes() {
  const fs::path root = PALACE_SOURCE_DIR;
  const std::regex pattern(R"(^\s*#include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const char* top : {"engine", "gui"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") {
        continue;
      }
      std::ifstream file(entry.path());
      int number = 0;
      for (std::string line; std::getline(file, line);) {
        ++number;
        std::smatch match;
        if (std::regex_search(line, match, pattern)) {
          includes.push_back({fs::relative(entry.path(), root).string(), number, match[2].str(),
                              match[1].str() == "<"});
        }
      }
    }
  }
  return includes;
}

struct RoomRule {
  bool anything = false;
  std::set<std::string> may_include;  ///< rooms and single files
};
using RoomRules = std::map<std::string, RoomRule>;

/// `camera` -> engine/camera; names with a room of their own stay.
std::string FullName(const std::string& name) {
  const bool has_top = name.rfind("gui/", 0) == 0 || name.rfind("engine/", 0) == 0;
  return has_top ? name : "engine/" + name;
}

std::vector<std::string> Quoted(const std::string& text) {
  std::vector<std::string> words;
  const std::regex quoted("`([^`]+)`");
  for (std::sregex_iterator at(text.begin(), text.end(), quoted), end; at != end; ++at) {
    words.push_back((*at)[1].str());
  }
  return words;
}

/// Rows `| room | holds | may include besides |` under the heading "Rooms", without header and
/// rule.
RoomRules ReadRoomTable(std::istream& text) {
  RoomRules rules;
  bool in_rooms = false;
  const std::regex row(R"(^\| `([a-z/]+)` \|[^|]*\|([^|]*)\|$)");
  for (std::string line; std::getline(text, line);) {
    in_rooms = line.rfind("## ", 0) == 0 ? line == "## Rooms" : in_rooms;
    std::smatch match;
    if (!in_rooms || !std::regex_match(line, match, row)) {
      continue;
    }
    const std::string room = FullName(match[1].str());
    RoomRule& rule = rules[room];
    rule.anything = match[2].str().find("anything") != std::string::npos;
    for (const std::string& name : Quoted(match[2].str())) {
      rule.may_include.insert(FullName(name));
    }
    if (room != "engine/core") {
      rule.may_include.insert("engine/core");
    }
    if (room != "engine/core" && room != "engine/model") {
      rule.may_include.insert("engine/model");
    }
  }
  return rules;
}

const RoomRules& Rules() {
  static const RoomRules rules = [] {
    std::ifstream file(fs::path(PALACE_SOURCE_DIR) / "ARCHITECTURE.md");
    return ReadRoomTable(file);
  }();
  return rules;
}

class IncludeRules : public testing::Test {
 protected:
  static const std::vector<Include>& All() {
    static const std::vector<Include> includes = ReadIncludes();
    return includes;
  }
};

TEST_F(IncludeRules, RoomsIncludeOnlyTheRoomsTheyMay) {
  ASSERT_GT(All().size(), 100u);
  for (const Include& include : All()) {
    const std::string from = RoomOf(include.file), to = RoomOf(include.path);
    const auto rule = Rules().find(from);
    if (include.system || to.empty() || from == to || rule == Rules().end() ||
        rule->second.anything) {
      continue;
    }
    EXPECT_TRUE(rule->second.may_include.count(to) || rule->second.may_include.count(include.path))
        << include.file << ":" << include.line << " includes " << include.path
        << ", which the table of ARCHITECTURE.md does not allow";
  }
}

TEST(RoomTable, HasEveryRoomAndOnlyRooms) {
  const fs::path root = PALACE_SOURCE_DIR;
  std::set<std::string> folders, rows;
  for (const char* top : {"engine", "gui"}) {
    for (const auto& entry : fs::directory_iterator(root / top)) {
      if (entry.is_directory()) {
        folders.insert(fs::relative(entry.path(), root).string());
      }
    }
  }
  for (const auto& [room, rule] : Rules()) {
    rows.insert(room);
    for (const std::string& name : rule.may_include) {
      EXPECT_TRUE(fs::exists(root / name)) << room << " may include " << name;
    }
  }
  EXPECT_EQ(folders, rows);
}

TEST(RoomTable, IsReadAsItIsWritten) {
  std::istringstream text(
      "| `camera` | of another table | anything |\n"
      "## Rooms\n\n| room | holds | may include besides |\n|---|---|---|\n"
      "| `core` | checks | |\n| `model` | grids | |\n"
      "| `wire` | messages | `camera`, `runtime/source.h` |\n| `gui/app` | all | anything |\n"
      "## Recipes\n| `stereo` | of another table | |\n");
  const RoomRules rules = ReadRoomTable(text);
  ASSERT_EQ(rules.size(), 4u);
  EXPECT_TRUE(rules.at("engine/core").may_include.empty());
  EXPECT_EQ(rules.at("engine/model").may_include, (std::set<std::string>{"engine/core"}));
  EXPECT_EQ(rules.at("engine/wire").may_include,
            (std::set<std::string>{"engine/core", "engine/model", "engine/camera",
                                   "engine/runtime/source.h"}));
  EXPECT_TRUE(rules.at("gui/app").anything);
}

/// Headers of libraries, by how their include begins, and the rooms that may use them.
TEST_F(IncludeRules, LibrariesStayInTheirRooms) {
  struct Rule {
    const char* begins;
    bool headers_too;
    std::set<std::string> rooms;
  };
  const std::set<std::string> vision = {
      "engine/camera",      "engine/calibration", "engine/stereo",    "engine/slad",
      "engine/tracking",    "engine/navigation",  "engine/capture",   "engine/wire",
      "gui/render",         "gui/platform",       "engine/tools",     "engine/survey",
      "engine/experiments", "engine/world",       "engine/simulation"};
  const std::vector<Rule> rules = {
      {"opencv2/", false, vision},
      {"lcm/", false, {"engine/wire", "engine/journal"}},
      {"palace/", true, {"engine/wire"}},
      {"GL/", true, {"gui/render", "gui/platform"}},
      {"EGL/", false, {"gui/platform"}},
      {"GLFW/", false, {"gui/platform", "gui/app"}},
      {"imgui", true, {"gui/widgets", "gui/panels", "gui/platform", "gui/app"}},
      {"sodium.h", false, {"engine/trust"}},
      {"toml++/",
       false,
       {"engine/camera", "engine/calibration", "engine/runtime", "engine/wire", "engine/simulation",
        "engine/world"}},
  };
  for (const Include& include : All()) {
    for (const Rule& rule : rules) {
      if (!include.system || include.path.rfind(rule.begins, 0) != 0) {
        continue;
      }
      // The one header that brings the TOML parser, with the macros every user of it needs.
      const bool header =
          include.file.back() == 'h' && include.file != "engine/camera/files/toml_table.h";
      EXPECT_TRUE(rule.rooms.count(RoomOf(include.file)) && (rule.headers_too || !header))
          << include.file << ":" << include.line << " includes <" << include.path << ">";
    }
  }
}

TEST_F(IncludeRules, NoThreadsOrClocksInAlgorithmRooms) {
  const std::set<std::string> algorithms = {
      "engine/model",   "engine/camera",   "engine/calibration", "engine/stereo",
      "engine/slad",    "engine/tracking", "engine/navigation",  "engine/flight",
      "engine/mission", "gui/panels",      "gui/widgets"};
  const std::set<std::string> forbidden = {"thread", "mutex", "future", "condition_variable",
                                           "chrono"};
  for (const Include& include : All()) {
    EXPECT_FALSE(algorithms.count(RoomOf(include.file)) && forbidden.count(include.path))
        << include.file << ":" << include.line << " includes <" << include.path << ">";
  }
}

TEST_F(IncludeRules, EveryHeaderIsGuardedAndOpensWithItsPurpose) {
  for (const char* top : {"engine", "gui"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PALACE_SOURCE_DIR) / top)) {
      if (entry.path().extension() != ".h") {
        continue;
      }
      std::ifstream file(entry.path());
      std::string first, text, line;
      std::getline(file, first);
      while (std::getline(file, line)) {
        text += line + "\n";
      }
      EXPECT_EQ(first.rfind("// ", 0), 0u) << entry.path() << " must open with a comment";
      EXPECT_NE(text.find("#pragma once"), std::string::npos) << entry.path();
    }
  }
}

// All rooms share one namespace: two types of one name that meet in a program are undefined
// behaviour that no compiler and no linker reports.
TEST(TypeNames, AreDefinedInOneHeaderOnly) {
  const std::regex pattern(
      R"(^(?:struct|class|enum|enum class)\s+(\w+)(?:\s+final)?\s*(?::\s[^;]*)?\{)");
  std::map<std::string, std::string> home;
  const fs::path root = PALACE_SOURCE_DIR;
  for (const char* top : {"engine", "gui"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().extension() != ".h") {
        continue;
      }
      const std::string header = fs::relative(entry.path(), root).string();
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        std::smatch match;
        if (std::regex_search(line, match, pattern)) {
          const auto [known, is_new] = home.emplace(match[1].str(), header);
          EXPECT_TRUE(is_new || known->second == header)
              << match[1] << " is defined in " << known->second << " and in " << header;
        }
      }
    }
  }
  EXPECT_GT(home.size(), 200u);
}

}  // namespace
}  // namespace palace
