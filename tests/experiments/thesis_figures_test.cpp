// The page of the thesis's figures asks only for experiments and pictures that there are.
#include "engine/experiments/thesis_figures.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/files.h"
#include "tests/support/own_path.h"
#include "tests/support/process.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

class ThesisPage : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(program_)) {
      GTEST_SKIP()
          << program_
          << " is not there: runs in builds that hold palacectl, not in those of the engine alone";
    }
    fs::create_directories(folder_);
  }
  ~ThesisPage() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  ProcessResult Evaluate(std::vector<std::string> words) const {
    ProcessOptions options;
    options.command = {program_.string(), "evaluate"};
    options.command.insert(options.command.end(), words.begin(), words.end());
    options.folder = folder_;
    return RunProcess(options, 240);
  }

  const fs::path program_ = fs::path(PALACE_BINARY_DIR) / "palacectl";
  const fs::path folder_ = OwnPath("");
};

TEST(ThesisFigures, AreAnsweredByExperimentsThatAreThere) {
  const fs::path program = fs::path(PALACE_BINARY_DIR) / "palacectl";
  if (!fs::exists(program)) {
    GTEST_SKIP()
        << program
        << " is not there: runs in builds that hold palacectl, not in those of the engine alone";
  }
  for (const ThesisFigure& figure : ThesisFigures()) {
    SCOPED_TRACE(figure.figure);
    EXPECT_FALSE(figure.found.empty() && figure.pictures.empty());
    if (!figure.experiment.empty()) {
      ProcessOptions options;
      options.command = {program.string(), "evaluate", std::string(figure.experiment), "--help"};
      EXPECT_EQ(RunProcess(options, 30).exit_code, 0);
    }
  }
}

TEST_F(ThesisPage, LaysResultsBesideWhatTheThesisFoundAndTellsWhatWasNotRun) {
  // Exit code 1: few trials keep no criterion.
  ASSERT_LE(Evaluate({"site-range", "--trials", "1", "--altitudes-ft", "50", "--cones-in", "28",
                      "--frames", "2", "--out", "range"})
                .exit_code,
            1);
  const ProcessResult made = Evaluate({"thesis", "range", "--out", "page"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Result<std::string> text = ReadTextFile(folder_ / "page" / "thesis.html", 10'000'000);
  ASSERT_TRUE(text) << text.error().message;
  const std::string& page = *text;
  EXPECT_NE(page.find("Table 4.5"), std::string::npos);
  EXPECT_NE(page.find("palacectl evaluate site-range, 1 trials, seed 1"), std::string::npos);
  EXPECT_NE(page.find("not run. palacectl evaluate position-estimate"), std::string::npos);
  for (const char* picture :
       {"obstacle-field.png", "range-map.png", "cluttered.png", "elevation.png", "slope.png",
        "roughness.png", "cost.png", "safe_distance.png", "safe-landing.png", "overlay.png"}) {
    EXPECT_NE(page.find(picture), std::string::npos) << picture;
    EXPECT_GT(fs::file_size(folder_ / "page" / picture), 1000u) << picture;
  }

  const ProcessResult twice = Evaluate({"thesis", "range", "range", "--out", "page"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("given twice"), std::string::npos) << twice.err;
  EXPECT_NE(Evaluate({"thesis", "nowhere", "--out", "page"}).exit_code, 0);
}

}  // namespace
}  // namespace palace
