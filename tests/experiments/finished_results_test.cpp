// Results under --out: a run with other options does not replace them unasked, the same run tells
// that it is done, and what a record keeps may be taken further.
#include "engine/experiments/finished_results.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include <CLI/CLI.hpp>

#include "engine/experiments/experiment.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FinishedResultsTest : public ::testing::Test {
 protected:
  ~FinishedResultsTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  struct Ran {
    int exit_code = 0;
    int trials = 0;  ///< that were run, not taken from a record
    std::string out, err;
  };
  /// `evaluate <words>` in this process, of an experiment that draws one number a trial.
  static Ran Evaluate(std::vector<std::string> words) {
    Ran ran;
    Experiment draws{.name = "draws",
                     .purpose = "numbers",
                     .columns = {"drawn"},
                     .setup = [] { return std::string("heights 8"); },
                     .run = [&ran](int, std::uint64_t seed) -> Result<std::vector<TrialRow>> {
                       ++ran.trials;
                       return std::vector<TrialRow>{{std::to_string(seed * 7)}};
                     },
                     .report =
                         [](const TrialTable& table) {
                           ExperimentReport report{.page = HtmlPage("Draws")};
                           report.lines.push_back("sum " + CsvNumber(table.Sum("drawn")));
                           return report;
                         }};
    CLI::App evaluate;
    AddExperiments(evaluate, {draws}, ran.exit_code);
    std::reverse(words.begin(), words.end());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    evaluate.parse(words);
    ran.out = ::testing::internal::GetCapturedStdout();
    ran.err = ::testing::internal::GetCapturedStderr();
    return ran;
  }
  std::string Out(const char* name = "run") const { return (folder_ / name).string(); }
  std::string Csv(const char* name = "run") const {
    std::ifstream file(folder_ / name / "draws.csv", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const fs::path folder_ = OwnPath("");
};

TEST_F(FinishedResultsTest, OfOtherOptionsAreRefusedWithWhatTheyAre) {
  ASSERT_EQ(Evaluate({"draws", "--trials", "6", "--out", Out()}).exit_code, 0);
  const std::string before = Csv();
  const std::vector<std::vector<std::string>> others = {
      {"draws", "--trials", "4", "--seed", "9", "--out", Out(), "--resume"},
      {"draws", "--trials", "4", "--seed", "9", "--out", Out()},
      {"draws", "--trials", "4", "--out", Out(), "--resume"},
      {"draws", "--trials", "6", "--shard", "1/2", "--out", Out(), "--resume"},
      {"draws", "--trials", "6", "--out", Out()}};
  for (const auto& words : others) {
    const Ran refused = Evaluate(words);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.trials, 0);
    EXPECT_THAT(refused.err,
                HasSubstr(Out() + "/draws.csv holds 6 trials of seed 1 (heights 8) "
                                  "already; choose another --out, or add --overwrite"));
    EXPECT_EQ(Csv(), before);
    EXPECT_FALSE(fs::exists(folder_ / "run" / "draws.trials")) << "of a run that was refused";
  }
  const Ran asked =
      Evaluate({"draws", "--trials", "4", "--seed", "9", "--out", Out(), "--overwrite"});
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_THAT(Csv(), HasSubstr("seed 9; trials 4"));
}

TEST_F(FinishedResultsTest, OfTheVerySameRunAreToldAgain) {
  const std::vector<std::string> words = {"draws", "--trials", "6", "--out", Out(), "--resume"};
  const Ran first = Evaluate(words);
  ASSERT_EQ(first.trials, 6);
  const Ran again = Evaluate(words);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.trials, 0);
  EXPECT_THAT(again.err, HasSubstr("draws.csv holds all 6 trials of seed 1 (heights 8)"));
  EXPECT_THAT(again.out, HasSubstr("sum 147"));
  EXPECT_FALSE(fs::exists(folder_ / "run" / "draws.trials"));
}

/// As Ctrl-C leaves it: the trials done are a table and are kept in the record as well.
TEST_F(FinishedResultsTest, ThatTheRecordKeepsAreTakenFurther) {
  ASSERT_EQ(Evaluate({"draws", "--trials", "2", "--out", Out()}).exit_code, 0);
  const TrialHeader header = {"draws", "heights 8", 1, 2, {}};
  {
    auto record =
        TrialRecord::Open(folder_ / "run" / "draws.trials", {header, {"drawn"}, ""}, false);
    ASSERT_TRUE(record);
    ASSERT_TRUE(record->Add(0, {{"7"}}));
    EXPECT_FALSE(IsKept(header, header, *record)) << "trial 1 would be lost";
    ASSERT_TRUE(record->Add(1, {{"14"}}));
    EXPECT_TRUE(IsKept(header, header, *record));
    TrialHeader other = header;
    other.seed = 9;
    EXPECT_FALSE(IsKept(other, header, *record));
  }
  const Ran further = Evaluate({"draws", "--trials", "5", "--out", Out(), "--resume"});
  EXPECT_EQ(further.exit_code, 0) << further.err;
  EXPECT_EQ(further.trials, 3);
  ASSERT_EQ(Evaluate({"draws", "--trials", "5", "--out", Out("whole")}).exit_code, 0);
  EXPECT_EQ(Csv(), Csv("whole"));
}

TEST_F(FinishedResultsTest, ThatAreNoTableAreNotReplacedEither) {
  fs::create_directories(folder_ / "run");
  std::ofstream(folder_ / "run" / "draws.csv") << "place,height\n1,2\n";
  const Ran refused = Evaluate({"draws", "--trials", "2", "--out", Out()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("names no experiment; choose another --out, or add --overwrite"));
  EXPECT_THAT(Csv(), HasSubstr("place,height"));
}

TEST_F(FinishedResultsTest, AreNotReplacedByShardsOfAnotherRun) {
  ASSERT_EQ(Evaluate({"draws", "--trials", "6", "--out", Out()}).exit_code, 0);
  for (const char* shard : {"1/2", "2/2"}) {
    ASSERT_EQ(Evaluate({"draws", "--trials", "4", "--shard", shard, "--out",
                        Out(shard[0] == '1' ? "one" : "two")})
                  .exit_code,
              0);
  }
  const std::vector<std::string> words = {"merge", "--out", Out(), Out("one"), Out("two")};
  const Ran refused = Evaluate(words);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("holds 6 trials of seed 1 (heights 8) already"));
  EXPECT_THAT(Csv(), HasSubstr("trials 6"));
  std::vector<std::string> anew = words;
  anew.emplace_back("--overwrite");
  EXPECT_EQ(Evaluate(anew).exit_code, 0);
  EXPECT_THAT(Csv(), HasSubstr("trials 4"));
  EXPECT_EQ(Evaluate(words).exit_code, 0) << "the same shards again are the same run";
}

}  // namespace
}  // namespace palace
