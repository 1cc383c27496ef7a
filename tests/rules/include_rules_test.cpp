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

#include "tests/rules/rule_text.h"

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
  int row = 0;  ///< of the table, from 0
  bool anything = false;
  std::set<std::string> may_include;  ///< rooms and single files
  std::set<std::string> named;        ///< of these, what the row itself says
};
using RoomRules = std::map<std::string, RoomRule>;

/// `camera` -> engine/camera; names with a room of their own stay.
std::string FullName(const std::string& name) {
  const bool has_top = name.rfind("gui/", 0) == 0 || name.rfind("engine/", 0) == 0;
  return has_top ? name : "engine/" + name;
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
    rule.row = static_cast<int>(rules.size()) - 1;
    rule.anything = match[2].str().find("anything") != std::string::npos;
    for (const std::string& name : Quoted(match[2].str())) {
      rule.named.insert(FullName(name));
    }
    rule.may_include = rule.named;
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

/// What a row allows and nobody uses is a wall with a hole in it.
TEST_F(IncludeRules, EveryPermissionIsUsed) {
  std::set<std::pair<std::string, std::string>> used;
  for (const Include& include : All()) {
    used.insert({RoomOf(include.file), RoomOf(include.path)});
    used.insert({RoomOf(include.file), include.path});
  }
  for (const auto& [room, rule] : Rules()) {
    for (const std::string& name : rule.named) {
      EXPECT_TRUE(used.count({room, name})) << room << " may include " << name << " and does not";
    }
  }
}

/// Complaints about a table in which a room may include one that stands below it. Single files (the
/// doors that rooms behind them implement) and rooms without walls are apart.
std::vector<std::string> UpwardIn(const RoomRules& rules) {
  std::vector<std::string> upward;
  for (const auto& [room, rule] : rules) {
    for (const std::string& name : rule.may_include) {
      const auto other = rules.find(name);
      if (!rule.anything && other != rules.end() && other->second.row >= rule.row) {
        upward.push_back(room + " -> " + name);
      }
    }
  }
  return upward;
}

TEST(RoomTable, RoomsIncludeOnlyRoomsAboveThem) {
  EXPECT_EQ(UpwardIn(Rules()), std::vector<std::string>{});
  std::istringstream text(
      "## Rooms\n| `core` | checks | |\n| `model` | grids | |\n"
      "| `camera` | lenses | `stereo`, `runtime/source.h` |\n| `stereo` | pairs | `camera` |\n"
      "| `tools` | verbs | anything |\n| `runtime` | pipeline | `stereo` |\n");
  EXPECT_EQ(UpwardIn(ReadRoomTable(text)),
            std::vector<std::string>{"engine/camera -> engine/stereo"});
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
      {"toml++/", false, {"engine/core", "engine/calibration", "engine/runtime", "engine/wire"}},
  };
  for (const Include& include : All()) {
    for (const Rule& rule : rules) {
      if (!include.system || include.path.rfind(rule.begins, 0) != 0) {
        continue;
      }
      // The one header that brings the TOML parser, with the macros every user of it needs.
      const bool header = include.file.back() == 'h' && include.file != "engine/core/toml_text.h";
      EXPECT_TRUE(rule.rooms.count(RoomOf(include.file)) && (rule.headers_too || !header))
          << include.file << ":" << include.line << " includes <" << include.path << ">";
    }
  }
}

const std::set<std::string>& AlgorithmRooms() {
  static const std::set<std::string> rooms = {
      "engine/model",  "engine/camera", "engine/report",   "engine/calibration",
      "engine/stereo", "engine/slad",   "engine/tracking", "engine/navigation",
      "engine/flight", "engine/trust",  "engine/mission",  "engine/world",
      "engine/survey", "engine/search", "engine/geodata",  "gui/panels",
      "gui/widgets"};
  return rooms;
}

TEST_F(IncludeRules, NoThreadsOrClocksInAlgorithmRooms) {
  const std::set<std::string> forbidden = {"thread", "mutex", "future", "condition_variable",
                                           "chrono"};
  for (const Include& include : All()) {
    EXPECT_FALSE(AlgorithmRooms().count(RoomOf(include.file)) && forbidden.count(include.path))
        << include.file << ":" << include.line << " includes <" << include.path << ">";
  }
}

/// Our own clocks come with core/time.h, which everybody needs for its stamps.
TEST_F(IncludeRules, NoCallsOfClocksInAlgorithmRooms) {
  const std::regex clock(R"(\b(MonotonicSeconds|WallTime|clock_gettime|gettimeofday)\s*\()");
  const fs::path root = PALACE_SOURCE_DIR;
  for (const std::string& room : AlgorithmRooms()) {
    ASSERT_TRUE(fs::exists(root / room)) << room;
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      if (!entry.is_regular_file()) {
        continue;
      }
      std::ifstream file(entry.path());
      int number = 0;
      for (std::string line; std::getline(file, line);) {
        ++number;
        EXPECT_FALSE(std::regex_search(line, clock))
            << entry.path() << ":" << number << ": " << line;
      }
    }
  }
  EXPECT_TRUE(std::regex_search("const double now = MonotonicSeconds();", clock));
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
