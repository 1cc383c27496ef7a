// Reads every include of the project and holds it against the table of rooms (ARCHITECTURE.md,
// "Rooms"). It does not prove that the rooms are well cut, only that the walls stand.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
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

/// The engine's doors: interfaces that the rooms behind them implement.
const std::set<std::string> kDoors = {"engine/runtime/source.h", "engine/runtime/vehicle_link.h",
                                      "engine/runtime/record_sink.h"};

/// Rooms a room may include, beside itself.
const std::map<std::string, std::set<std::string>>& Allowed() {
  static const std::set<std::string> base = {"engine/core", "engine/model"};
  static const auto with = [](std::set<std::string> more) {
    more.insert(base.begin(), base.end());
    return more;
  };
  static const std::map<std::string, std::set<std::string>> table = {
      {"engine/core", {}},
      {"engine/model", {"engine/core"}},
      {"engine/camera", base},
      {"engine/report", base},
      {"engine/calibration", with({"engine/camera", "engine/report"})},
      {"engine/stereo", with({"engine/camera", "engine/calibration"})},
      {"engine/slad", with({"engine/camera", "engine/calibration", "engine/stereo"})},
      {"engine/tracking", with({"engine/camera", "engine/stereo", "engine/slad"})},
      {"engine/navigation",
       with({"engine/camera", "engine/stereo", "engine/slad", "engine/tracking"})},
      {"engine/flight", with({"engine/camera", "engine/navigation", "engine/tracking"})},
      {"engine/trust", base},
      {"engine/mission", with({"engine/camera", "engine/flight", "engine/navigation",
                               "engine/tracking", "engine/trust"})},
      {"engine/capture", with({"engine/camera"})},
      {"engine/world", with({"engine/camera"})},
      {"engine/simulation",
       with({"engine/camera", "engine/flight", "engine/trust", "engine/world"})},
      {"engine/wire", with({"engine/camera"})},
      {"engine/journal", with({"engine/camera", "engine/wire"})},
      {"engine/runtime", with({"engine/camera", "engine/stereo", "engine/slad", "engine/tracking",
                               "engine/navigation", "engine/flight", "engine/mission",
                               "engine/trust", "engine/world"})},
      {"engine/survey", with({"engine/camera", "engine/stereo", "engine/slad"})},
      {"engine/experiments",
       with({"engine/camera", "engine/calibration", "engine/stereo", "engine/slad",
             "engine/tracking", "engine/navigation", "engine/flight", "engine/mission",
             "engine/trust", "engine/world", "engine/simulation", "engine/runtime", "engine/report",
             "engine/survey"})},
      {"gui/widgets", base},
      {"gui/panels", with({"gui/widgets"})},
      {"gui/render", with({"engine/world"})},
      {"gui/platform", with({"gui/render", "engine/world"})},
  };
  return table;
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
    const auto rule = Allowed().find(from);
    if (include.system || to.empty() || from == to || rule == Allowed().end()) {
      continue;
    }
    const bool door = kDoors.count(include.path) != 0 && from.rfind("engine/", 0) == 0;
    const bool intent = include.path == "gui/app/intent.h";
    const bool scene_camera = include.path == "engine/simulation/scene_camera.h" &&
                              (from == "gui/render" || from == "gui/platform");
    EXPECT_TRUE(rule->second.count(to) || door || intent || scene_camera)
        << include.file << ":" << include.line << " includes " << include.path;
  }
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
