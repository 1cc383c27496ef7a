// Tests of one program run side by side, each in a process of its own: two that share a path in the
// folder for temporary files fail by chance. One file knows that folder; this test keeps it at one.
#include <filesystem>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "tests/rules/rule_text.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

TEST(OwnPaths, OneFileKnowsTheFolderForTemporaryFiles) {
  // The fuzzer's targets write into memory where they can, by their process's number.
  const fs::path root = PALACE_SOURCE_DIR, allowed[] = {root / "tests/support/own_path.h",
                                                        root / "tests/fuzz/file_targets.cpp"};
  const std::regex forbidden(R"(\bTempDir\s*\(|\btemp_directory_path\s*\()");
  int seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "tests")) {
    const std::string extension = entry.path().extension();
    if ((extension != ".h" && extension != ".cpp") || entry.path() == allowed[0] ||
        entry.path() == allowed[1]) {
      continue;
    }
    ++seen;
    EXPECT_FALSE(std::regex_search(CodeOf(ReadText(entry.path())), forbidden))
        << entry.path() << ": use tests/support/own_path.h";
  }
  EXPECT_GT(seen, 200);
  EXPECT_TRUE(std::regex_search(CodeOf(ReadText(allowed[0])), forbidden)) << "the pattern finds";
}

}  // namespace
}  // namespace palace
