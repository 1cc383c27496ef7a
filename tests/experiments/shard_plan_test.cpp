// Sizes of shards, and the texts that GNU parallel, Slurm and a person are given, to the letter.
// That they do what they should is shown by shard_plan_run_test.cpp.
#include "engine/experiments/shard_plan.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/process.h"

namespace palace {
namespace {

struct SizeRow {
  const char* what;
  int trials;
  double trial_s, job_s;
  int shards, largest_trials;
  double largest_s;
};

TEST(ShardPlan, ShardsAreAsFewAsTheTimeOfAJobAllows) {
  const SizeRow rows[] = {
      {"ten jobs, even", 100, 60, 600, 10, 10, 600},
      {"the rest is spread, no shard is short", 101, 60, 600, 11, 10, 600},
      {"all in one job", 5, 1, 600, 1, 5, 5},
      {"fewer trials than fit a job", 1, 41, 600, 1, 1, 41},
      {"one trial longer than a job", 7, 1000, 600, 7, 1, 1000},
      {"one trial as long as a job", 7, 600, 600, 7, 1, 600},
      {"a job of 1.9 trials holds one", 6, 60, 114, 6, 1, 60},
      {"0.3 s hold three of 0.1 s", 9, 0.1, 0.3, 3, 3, 0.3},
      {"as many shards as there may be", 10'000, 600, 600, 10'000, 1, 600},
      {"most trials", 1'000'000, 0.001, 2'592'000, 1, 1'000'000, 1000},
  };
  for (const SizeRow& row : rows) {
    SCOPED_TRACE(row.what);
    const Result<ShardSizes> sizes = SizeShards(row.trials, row.trial_s, row.job_s);
    ASSERT_TRUE(sizes.ok());
    EXPECT_EQ(sizes->shards, row.shards);
    EXPECT_EQ(sizes->largest_trials, row.largest_trials);
    EXPECT_NEAR(sizes->largest_s, row.largest_s, 1e-9);
  }
}

TEST(ShardPlan, NoShardIsEmptyAndNoneTakesLongerThanAJobUnlessOneTrialDoes) {
  for (int trials = 1; trials <= 200; ++trials) {
    for (const double trial_s : {0.7, 3.0, 7.0, 41.0, 100.0}) {
      SCOPED_TRACE(testing::Message() << trials << " trials of " << trial_s << " s");
      const Result<ShardSizes> sizes = SizeShards(trials, trial_s, 60);
      ASSERT_TRUE(sizes.ok());
      EXPECT_LE(sizes->shards, trials);
      EXPECT_GE(sizes->shards * sizes->largest_trials, trials);
      EXPECT_TRUE(sizes->largest_s <= 60 || sizes->largest_trials == 1) << sizes->largest_s;
    }
  }
}

TEST(ShardPlan, TooManyShardsAreRefusedWithTheJobThatWouldDo) {
  const Result<ShardSizes> sizes = SizeShards(1'000'000, 41, 600);
  ASSERT_FALSE(sizes.ok());
  EXPECT_EQ(sizes.error().code, ErrorCode::kUsage);
  EXPECT_EQ(sizes.error().message,
            "--per-job 600s: 71429 shards, at most 10000; give --per-job 4100s or more");
  ASSERT_TRUE(SizeShards(1'000'000, 41, 4100).ok());
  EXPECT_EQ(SizeShards(1'000'000, 41, 4100)->shards, 10'000);
}

TEST(ShardPlan, DurationsCarryTheirUnit) {
  const std::pair<const char*, double> good[] = {
      {"90s", 90}, {"10min", 600}, {"2h", 7200}, {"1.5h", 5400}, {"1s", 1}, {"720h", 2'592'000}};
  for (const auto& [text, seconds] : good) {
    const Result<double> read = ParseDuration(text, "--per-job");
    ASSERT_TRUE(read.ok()) << text;
    EXPECT_DOUBLE_EQ(*read, seconds) << text;
  }
  for (const char* text : {"", "10", "min", "10 min", "10m", "10minutes", "-5min", "0s", "0.9s",
                           "721h", "nans", "infh", "1e9h", "10min "}) {
    const Result<double> read = ParseDuration(text, "--per-job");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().code, ErrorCode::kUsage);
    EXPECT_EQ(read.error().message,
              "--per-job " + std::string(text) +
                  ": give a number with its unit, s, min or h, from 1s to 720h, e.g. 10min");
  }
  EXPECT_EQ(DurationText(0.001), "0.001 s");
  EXPECT_EQ(DurationText(41), "41 s");
  EXPECT_EQ(DurationText(90), "1.5 min");
  EXPECT_EQ(DurationText(600), "10.0 min");
  EXPECT_EQ(DurationText(36'000), "10.0 h");
}

ShardedRun LandingRun() {
  ShardedRun run;
  run.experiment = "landing";
  run.options = {"--fault", "lost=20"};
  run.setup = "runway, calm, fault lost=20";
  run.trials = 100;
  run.seed = 7;
  run.out = "landings";
  return run;
}

TEST(ShardPlan, LinesForGnuParallel) {
  EXPECT_EQ(ParallelLines(LandingRun(), {7, 15, 615}),
            R"(for i in $(seq 7); do
  grep -qsxF '# palace evaluate landing; seed 7; trials 100; shard '"$i"'/7; runway, calm, fault lost=20' landings/shard-"$i"-of-7/landing.csv || echo "$i"
done | parallel --sshloginfile machines.txt --workdir . \
  --return landings/shard-{}-of-7/landing.csv \
  'palacectl evaluate landing --fault lost=20 --trials 100 --seed 7 --resume --shard {}/7 --out landings/shard-{}-of-7'
)");
}

TEST(ShardPlan, ScriptForSlurm) {
  EXPECT_EQ(SlurmScript(LandingRun(), {7, 15, 615}),
            R"(#!/bin/sh
#SBATCH --job-name=palace-landing
#SBATCH --array=1-7
#SBATCH --cpus-per-task=1
#SBATCH --time=31
#SBATCH --requeue
#SBATCH --output=palace-landing-%A_%a.log
i=${SLURM_ARRAY_TASK_ID:?give this script to sbatch}
if grep -qsxF '# palace evaluate landing; seed 7; trials 100; shard '"$i"'/7; runway, calm, fault lost=20' landings/shard-"$i"-of-7/landing.csv; then
  echo "shard $i of 7 is done"
  exit 0
fi
exec palacectl evaluate landing --fault lost=20 --trials 100 --seed 7 --resume --shard "$i"/7 --out landings/shard-"$i"-of-7
)");
  const std::string large = SlurmScript(LandingRun(), {1001, 1, 1});
  EXPECT_NE(large.find("#SBATCH --time=10\n"), std::string::npos) << large;
  EXPECT_NE(large.find("# Many clusters take 1000 tasks an array (MaxArraySize in: scontrol show "
                       "config); this has 1001.\n"),
            std::string::npos)
      << large;
}

TEST(ShardPlan, LineThatJoins) {
  EXPECT_EQ(MergeLine(LandingRun(), {7, 15, 615}),
            "palacectl evaluate merge --out landings landings/shard-*-of-7/landing.csv\n");
}

TEST(ShardPlan, WordsSurviveTheShell) {
  const std::pair<const char*, const char*> rows[] = {
      {"lost=20", "lost=20"},
      {"/opt/palace/palacectl", "/opt/palace/palacectl"},
      {"", "''"},
      {"my yard.toml", "'my yard.toml'"},
      {"Bob's", R"('Bob'\''s')"},
      {"$HOME;`id`", "'$HOME;`id`'"},
      {"{}", "'{''}'"}};
  for (const auto& [word, quoted] : rows) {
    EXPECT_EQ(ShellWord(word), quoted);
    ProcessOptions shell;
    shell.command = {"/bin/sh", "-c", "printf %s " + ShellWord(word)};
    EXPECT_EQ(RunProcess(shell, 10).out, word);
  }
}

TEST(ShardPlan, NamesWithSpacesAreQuotedTwiceWhereTwoShellsReadThem) {
  ShardedRun run = LandingRun();
  run.program = "/opt/my palace/palacectl";
  run.options = {"--set", "it's {}"};
  run.out = "my landings";
  run.machines = "my machines.txt";
  const std::string lines = ParallelLines(run, {2, 50, 2050});
  EXPECT_NE(lines.find("--sshloginfile 'my machines.txt' --workdir . \\\n"
                       "  --return 'my landings/shard-'{}-of-2/landing.csv \\\n"),
            std::string::npos)
      << lines;
  EXPECT_NE(
      lines.find(
          R"(''\''/opt/my palace/palacectl'\'' evaluate landing --set )"
          R"('\''it'\''\'\'''\''s {'\'''\''}'\'' --trials 100 --seed 7 --resume --shard {}/2 )"
          R"(--out '\''my landings/shard-'\''{}-of-2')"),
      std::string::npos)
      << lines;
  EXPECT_EQ(MergeLine(run, {2, 50, 2050}),
            "'/opt/my palace/palacectl' evaluate merge --out 'my landings' "
            "'my landings/shard-'*-of-2/landing.csv\n");
}

TEST(ShardPlan, FoldersThatWouldBeReadOtherwiseAreRefused) {
  for (const char* good : {"landings", "my landings", "/data/x", "a/b", "a-b"}) {
    EXPECT_TRUE(CheckShardFolder(good).ok()) << good;
  }
  for (const char* bad : {"", "-x", "a{}", "a{1}b", "a\nb"}) {
    const Status status = CheckShardFolder(bad);
    ASSERT_FALSE(status.ok()) << bad;
    EXPECT_EQ(status.error().code, ErrorCode::kUsage);
    EXPECT_EQ(status.error().message.rfind("--out '" + std::string(bad) + "'", 0), 0u);
  }
}

}  // namespace
}  // namespace palace
