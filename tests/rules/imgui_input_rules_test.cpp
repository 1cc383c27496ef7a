// Dear ImGui 1.86 takes input by arrays, 1.89 and later by events, and each refuses the other's way
// at compile time or in the first frame. One file knows both; this test keeps it at one.
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace palace {
namespace {

namespace fs = std::filesystem;

TEST(ImGuiInput, GoesThroughOneFile) {
  const std::regex forbidden(
      R"(\bKeyMap\b|\bKeysDown\b|\bGetKeyIndex\b|\bIsKeyPressed\b|\bIsKeyDown\b|\bAddKeyEvent\b)"
      R"(|\bAddMouse\w+Event\b|\.(MousePos|MouseDown\[\w+\]|MouseWheel|KeyShift|KeyCtrl)\s*[|+-]?=[^=])");
  int seen = 0;
  for (const char* top : {"gui", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PALACE_SOURCE_DIR) / top)) {
      const std::string extension = entry.path().extension();
      const std::string name = entry.path().filename();
      if ((extension != ".h" && extension != ".cpp") || name == "imgui_input.cpp" ||
          name == "imgui_input_rules_test.cpp") {
        continue;
      }
      ++seen;
      std::ifstream file(entry.path());
      int number = 0;
      for (std::string line; std::getline(file, line);) {
        ++number;
        EXPECT_FALSE(std::regex_search(line, forbidden))
            << entry.path() << ":" << number << ": use gui/widgets/imgui_input.h for\n"
            << line;
      }
    }
  }
  EXPECT_GT(seen, 100);
}

}  // namespace
}  // namespace palace
