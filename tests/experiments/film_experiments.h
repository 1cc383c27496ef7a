// Films of a few pictures over coarse ground, and shards that must join to the byte: what the tests
// of `evaluate trackers` and `evaluate occlusion` share.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "engine/experiments/experiment.h"
#include "engine/experiments/film_ground.h"
#include "engine/report/trial_table.h"

namespace palace {

/// Coarse and quick; of the width of the real one.
inline constexpr GroundPyramid::Extent kCoarse{0.04, 640, 4};

inline FilmGroundOptions Short(int pictures) {
  FilmGroundOptions options;
  options.materials = {"gravel", "soil"};
  options.film.pictures = pictures;
  options.extent = kCoarse;
  return options;
}

/// Small pictures, too.
inline FilmGroundOptions ShortAndSmall(int pictures) {
  FilmGroundOptions options = Short(pictures);
  options.film.width_px = 192;
  options.film.height_px = 144;
  return options;
}

/// Trials of that shard, as the command writes them.
inline TrialFile RunOf(const Experiment& experiment, const Shard& shard, int trials) {
  TrialFile file;
  file.header = {experiment.name, experiment.setup(), 7, trials, shard};
  file.table.columns = {"trial", "seed"};
  file.table.columns.insert(file.table.columns.end(), experiment.columns.begin(),
                            experiment.columns.end());
  for (int trial = 0; trial < trials; ++trial) {
    if (!shard.Holds(trial)) {
      continue;
    }
    const std::uint64_t seed = TrialSeed(7, trial);
    const Result<std::vector<TrialRow>> rows = experiment.run(trial, seed);
    EXPECT_TRUE(rows.ok());
    for (const TrialRow& values : *rows) {
      EXPECT_EQ(values.size(), experiment.columns.size());
      file.table.rows.push_back({std::to_string(trial), std::to_string(seed)});
      file.table.rows.back().insert(file.table.rows.back().end(), values.begin(), values.end());
    }
  }
  return file;
}

inline void ExpectThatShardsJoin(const Experiment& experiment) {
  const TrialFile whole = RunOf(experiment, {1, 1}, 2);
  TrialFile first = whole;  // what it ran before the trial of the other shard
  first.header.shard = {1, 2};
  first.table = whole.table.Where("trial", "0");
  const Result<TrialFile> joined = MergeTrialFiles({RunOf(experiment, {2, 2}, 2), first});
  ASSERT_TRUE(joined.ok()) << joined.error().message;
  EXPECT_EQ(TrialFileText(*joined), TrialFileText(whole));
  EXPECT_EQ(experiment.report(joined->table).page.Text(),
            experiment.report(whole.table).page.Text());
}

}  // namespace palace
