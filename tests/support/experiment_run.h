// Trials of an experiment run in the test's own process, as `palacectl evaluate` runs them.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "engine/experiments/experiment.h"
#include "engine/report/trial_table.h"

namespace palace {

/// Without rows: to be filled by a test.
inline TrialTable EmptyTable(const Experiment& experiment) {
  TrialTable table{.columns = {"trial", "seed"}, .rows = {}};
  table.columns.insert(table.columns.end(), experiment.columns.begin(), experiment.columns.end());
  return table;
}

inline TrialFile RunExperimentTrials(const Experiment& experiment, std::uint64_t seed, int trials,
                                     const Shard& shard = {}) {
  TrialFile file;
  file.header = {experiment.name, experiment.setup ? experiment.setup() : "", seed, trials, shard};
  file.table = EmptyTable(experiment);
  for (int trial = 0; trial < trials; ++trial) {
    if (!shard.Holds(trial)) {
      continue;
    }
    const std::uint64_t trial_seed = TrialSeed(seed, trial);
    const Result<std::vector<TrialRow>> rows = experiment.run(trial, trial_seed);
    EXPECT_TRUE(rows) << rows.error().message;
    for (const TrialRow& row : rows ? *rows : std::vector<TrialRow>()) {
      EXPECT_EQ(row.size(), experiment.columns.size());
      file.table.rows.push_back({std::to_string(trial), std::to_string(trial_seed)});
      file.table.rows.back().insert(file.table.rows.back().end(), row.begin(), row.end());
    }
  }
  return file;
}

/// The same trials whole, and in shards that are written, read and merged: to the byte. A report
/// can be made of them.
inline void ExpectShardsMerge(const Experiment& experiment, std::uint64_t seed, int trials,
                              int count) {
  std::vector<TrialFile> shards;
  for (int index = count; index >= 1; --index) {
    const TrialFile shard = RunExperimentTrials(experiment, seed, trials, {index, count});
    Result<TrialFile> read = ParseTrialFile(TrialFileText(shard), "shard");
    ASSERT_TRUE(read) << read.error().message;
    shards.push_back(*std::move(read));
  }
  const Result<TrialFile> merged = MergeTrialFiles(shards);
  ASSERT_TRUE(merged) << merged.error().message;
  EXPECT_EQ(TrialFileText(*merged), TrialFileText(RunExperimentTrials(experiment, seed, trials)));
  EXPECT_FALSE(experiment.report(merged->table).lines.empty());
}

}  // namespace palace
