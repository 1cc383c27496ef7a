// What `palacectl evaluate plan` prints, run. Where GNU parallel is not installed a loop stands in
// for it; where no Slurm of one node runs, the variable that it sets does. That an ssh connection
// carries the files is not shown here.
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"
#include "tests/support/process.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

/// Of the options that the printed lines use; `{}` is replaced by each line of stdin.
constexpr const char* kParallelStandIn = R"sh(#!/bin/sh
while [ $# -gt 1 ]; do
  case $1 in --sshloginfile|--workdir|--return) shift 2 ;; *) exit 255 ;; esac
done
failed=0
while read -r line; do
  sh -c "$(printf '%s' "$1" | sed "s/{}/$line/g")" </dev/null || failed=$((failed + 1))
done
exit $failed
)sh";

std::string TextOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Four trials of 0.1 s, in shards of two.
class PrintedLines : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(program_)) {
      GTEST_SKIP()
          << program_
          << " is not there: runs in builds that hold palacectl, not in those of the engine alone";
    }
    folder_ = OwnPath(" it's");
    fs::create_directories(folder_ / "bin");
    std::ofstream(folder_ / "machines.txt") << "2/:\n";
    if (FindProgram("parallel").empty()) {
      const fs::path stand_in = folder_ / "bin/parallel";
      std::ofstream(stand_in) << kParallelStandIn;
      chmod(stand_in.c_str(), 0755);
    }
  }
  ~PrintedLines() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  ProcessResult Run(std::vector<std::string> command, const char* task = nullptr) const {
    ProcessOptions options;
    options.command = std::move(command);
    options.folder = folder_;
    const char* path = std::getenv("PATH");
    options.environment = {
        {"PATH", (folder_ / "bin").string() + ":" + (path == nullptr ? "/usr/bin:/bin" : path)}};
    if (task != nullptr) {
      options.environment.emplace_back("SLURM_ARRAY_TASK_ID", task);
    }
    return RunProcess(options, 120);
  }
  ProcessResult Palacectl(std::vector<std::string> words) const {
    words.insert(words.begin(), {program_.string(), "evaluate"});
    return Run(std::move(words));
  }
  /// Of a quick experiment, with names that a shell would take apart.
  ProcessResult Plan(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"plan",
                                      "probability",
                                      "--trials",
                                      "4",
                                      "--seed",
                                      "5000000",
                                      "--per-job",
                                      "2s",
                                      "--seconds-per-trial",
                                      "1",
                                      "--out",
                                      "the shards",
                                      "--write",
                                      "plan",
                                      "--set",
                                      "slad.gear=pads",
                                      "--set",
                                      "slad.max_slope_deg=8"};
    words.insert(words.end(), more.begin(), more.end());
    return Palacectl(std::move(words));
  }
  /// The whole run in one, to compare with; a report that is not passed is an exit of 1.
  void RunWhole() const {
    const ProcessResult whole =
        Palacectl({"probability", "--trials", "4", "--seed", "5000000", "--set", "slad.gear=pads",
                   "--set", "slad.max_slope_deg=8", "--out", "whole"});
    ASSERT_TRUE(whole.exit_code == 0 || whole.exit_code == 1) << whole.err;
  }
  void ExpectJoinedLikeWhole() const {
    const ProcessResult merged = Run({"/bin/sh", "plan/merge.sh"});
    EXPECT_TRUE(merged.exit_code == 0 || merged.exit_code == 1) << merged.err;
    for (const char* name : {"probability.csv", "report.html"}) {
      const std::string whole = TextOf(folder_ / "whole" / name);
      EXPECT_GT(whole.size(), 100u) << name;
      EXPECT_TRUE(TextOf(folder_ / "the shards" / name) == whole) << name << ": " << merged.err;
    }
  }
  fs::path Csv(int shard) const {
    return folder_ / "the shards" / ("shard-" + std::to_string(shard) + "-of-2") /
           "probability.csv";
  }

  const fs::path program_ = fs::path(PALACE_BINARY_DIR) / "palacectl";
  fs::path folder_;
};

TEST_F(PrintedLines, OfGnuParallelMakeTheFilesOfOneRunAndGoOnAfterAKill) {
  const ProcessResult plan = Plan();
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_EQ(plan.out.rfind("# probability: 4 trials, seed 5000000; one takes 1 s (as given)\n"
                           "# 2 shards of 2 trials at most: 2 s each, 4 s in all on one core\n",
                           0),
            0u)
      << plan.out;
  for (const char* file : {"slurm.sh", "parallel.sh", "merge.sh"}) {
    std::string text = TextOf(folder_ / "plan" / file);
    const bool headed = std::string(file) != "slurm.sh";
    text = headed ? text.substr(text.find('\n') + 1) : text;
    EXPECT_NE(plan.out.find(text), std::string::npos) << file << "\n" << plan.out;
  }
  RunWhole();
  const ProcessResult first = Run({"/bin/sh", "plan/parallel.sh"});
  ASSERT_EQ(first.exit_code, 0) << first.out << first.err;
  ExpectJoinedLikeWhole();

  // As after a kill: one shard is there, the other is not. What is there is not written again.
  fs::remove(Csv(2));
  const auto written = fs::last_write_time(Csv(1));
  const ProcessResult unjoined = Run({"/bin/sh", "plan/merge.sh"});
  EXPECT_EQ(unjoined.exit_code, 1);
  EXPECT_NE(unjoined.err.find("shard 2/2 is missing"), std::string::npos) << unjoined.err;
  ASSERT_EQ(Run({"/bin/sh", "plan/parallel.sh"}).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(Csv(1)), written);
  fs::remove(folder_ / "the shards/report.html");
  ExpectJoinedLikeWhole();

  // A shard of other options under the same name is none of this run, and not lost to it.
  std::string other = TextOf(Csv(1));
  other.replace(other.find("max_slope_deg=8"), 15, "max_slope_deg=7");
  std::ofstream(Csv(1), std::ios::binary) << other;
  const ProcessResult refused = Run({"/bin/sh", "plan/parallel.sh"});
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_NE(refused.err.find("already; choose another --out"), std::string::npos) << refused.err;
  EXPECT_EQ(TextOf(Csv(1)), other);
  fs::remove(Csv(1));
  ASSERT_EQ(Run({"/bin/sh", "plan/parallel.sh"}).exit_code, 0);
  ExpectJoinedLikeWhole();
}

TEST_F(PrintedLines, OfSlurmMakeTheFilesOfOneRunAndGoOnAfterAKill) {
  ASSERT_EQ(Plan().exit_code, 0);
  RunWhole();
  const ProcessResult alone = Run({"/bin/sh", "plan/slurm.sh"});
  EXPECT_NE(alone.exit_code, 0);
  EXPECT_NE(alone.err.find("give this script to sbatch"), std::string::npos) << alone.err;
  for (const char* task : {"1", "2"}) {
    const ProcessResult done = Run({"/bin/sh", "plan/slurm.sh"}, task);
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  const ProcessResult again = Run({"/bin/sh", "plan/slurm.sh"}, "2");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.out, "shard 2 of 2 is done\n");
  ExpectJoinedLikeWhole();
}

TEST_F(PrintedLines, OfSlurmAreTakenByAOneNodeCluster) {
  if (FindProgram("sbatch").empty()) {
    GTEST_SKIP() << "runs with Slurm (sbatch) installed";
  }
  const ProcessResult nodes = Run({"sinfo", "--noheader", "--format=%D %t"});
  if (nodes.exit_code != 0 || nodes.out != "1 idle\n") {
    GTEST_SKIP() << "runs where Slurm has one idle node; this one has: " << nodes.out << nodes.err;
  }
  ASSERT_EQ(Plan().exit_code, 0);
  RunWhole();
  const ProcessResult done = Run({"sbatch", "--wait", "plan/slurm.sh"});
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  ExpectJoinedLikeWhole();
}

TEST_F(PrintedLines, WithoutATimeOneTrialIsTimed) {
  const ProcessResult plan = Palacectl({"plan", "probability", "--trials", "3"});
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_NE(plan.err.find("timing one trial of probability"), std::string::npos) << plan.err;
  EXPECT_NE(plan.out.find(" s (measured: the first one, here)\n# 1 shard of 3 trials at most: "),
            std::string::npos)
      << plan.out;
}

TEST_F(PrintedLines, OptionsComeBackAsTheyWereGiven) {
  const ProcessResult plan = Palacectl({"plan", "families", "--seconds-per-trial", "50", "--trials",
                                        "2", "--family", "rocks", "--no-search", "--wind=4",
                                        "--set", "slad.max_slope_deg=8", "--program", "palacectl"});
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_NE(
      plan.out.find("'palacectl evaluate families --family rocks --wind 4 --set "
                    "slad.max_slope_deg=8 --no-search --trials 2 --seed 1 --resume --shard {}/1 "
                    "--out evaluate-families/shard-{}-of-1'"),
      std::string::npos)
      << plan.out;
  const ProcessResult list = Palacectl({"plan", "ground", "--seconds-per-trial", "50", "--heights",
                                        "8,15", "--pictures", "my pictures"});
  ASSERT_EQ(list.exit_code, 0) << list.err;
  EXPECT_NE(list.out.find(" --heights 8 --heights 15 --pictures 'my pictures' --trials "),
            std::string::npos)
      << list.out;
}

TEST_F(PrintedLines, BadValuesAreNamedWithTheirLimits) {
  struct Row {
    std::vector<std::string> words;
    const char* said;
  };
  const Row rows[] = {
      {{"--per-job", "10"}, "--per-job 10: give a number with its unit"},
      {{"--seconds-per-trial", "0"}, "--seconds-per-trial: 0 is not within 0.001 to 2592000"},
      {{"--trials", "0"}, "--trials: 0 is not within 1 to 1000000"},
      {{"--out", "a{}"}, "--out 'a{}': give a folder"},
      {{"--fault", "x"}, "palacectl evaluate plan probability has no option --fault"},
      {{"--shard", "1/2"}, "palacectl evaluate plan probability has no option --shard"},
      {{"--trials", "1000000", "--seconds-per-trial", "600"}, "give --per-job 60000s or more"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.said);
    std::vector<std::string> words = {"plan", "probability"};
    words.insert(words.end(), row.words.begin(), row.words.end());
    const ProcessResult result = Palacectl(words);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(row.said), std::string::npos) << result.err;
  }
  const ProcessResult unnamed = Palacectl({"plan"});
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_NE(unnamed.err.find("choose one of landing, "), std::string::npos) << unnamed.err;
}

}  // namespace
}  // namespace palace
