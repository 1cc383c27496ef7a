// Shards of an experiment merge to the file one run writes; everything else is refused with a
// reason.
#include "engine/report/trial_table.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

/// Trials 0 .. count-1 of a made-up experiment, two rows each, as one shard runs them.
TrialFile RunShard(int count, Shard shard, std::uint64_t seed = 5) {
  TrialFile file;
  file.header = {"site-range", "scene cones", seed, count, shard};
  file.table.columns = {"trial", "seed", "altitude_ft", "found"};
  for (int trial = 0; trial < count; ++trial) {
    if (!shard.Holds(trial)) {
      continue;
    }
    RandomStream random(seed + static_cast<std::uint64_t>(trial));
    for (const char* altitude : {"30", "70"}) {
      file.table.rows.push_back({std::to_string(trial),
                                 std::to_string(seed + static_cast<std::uint64_t>(trial)), altitude,
                                 CsvNumber(random.Uniform())});
    }
  }
  return file;
}

TEST(TrialTable, ShardsInAnyOrderMergeToTheUnshardedFile) {
  const std::string whole = TrialFileText(RunShard(17, {1, 1}));
  for (const int shards : {2, 3, 5, 17, 20}) {
    std::vector<TrialFile> parts;
    for (int i = shards; i >= 1; --i) {
      const auto part = ParseTrialFile(TrialFileText(RunShard(17, {i, shards})), "part.csv");
      ASSERT_TRUE(part) << part.error().message;
      parts.push_back(*part);
    }
    const auto merged = MergeTrialFiles(parts);
    ASSERT_TRUE(merged) << merged.error().message;
    EXPECT_EQ(TrialFileText(*merged), whole) << shards << " shards";
  }
}

TEST(TrialTable, ShardsOfDifferentRunsAreRefused) {
  struct Row {
    const char* name;
    std::vector<TrialFile> shards;
    const char* says;
  };
  TrialFile other = RunShard(9, {2, 2});
  other.header.setup = "scene slope";
  const std::vector<Row> table = {
      {"missing", {RunShard(9, {1, 2})}, "shard 2/2 is missing"},
      {"twice", {RunShard(9, {1, 2}), RunShard(9, {1, 2})}, "given twice"},
      {"seed", {RunShard(9, {1, 2}), RunShard(9, {2, 2}, 6)}, "not of one run"},
      {"trials", {RunShard(9, {1, 2}), RunShard(10, {2, 2})}, "not of one run"},
      {"setup", {RunShard(9, {1, 2}), other}, "not of one run"},
      {"none", {}, "give the folders"},
  };
  for (const Row& row : table) {
    const auto merged = MergeTrialFiles(row.shards);
    ASSERT_FALSE(merged) << row.name;
    EXPECT_NE(merged.error().message.find(row.says), std::string::npos) << merged.error().message;
  }
}

TEST(TrialTable, DamagedFilesAreRefusedWithTheirLine) {
  const std::string good = TrialFileText(RunShard(3, {1, 1}));
  const auto first_line = good.find('\n') + 1;
  struct Row {
    const char* name;
    std::string text;
    const char* says;
  };
  const std::vector<Row> table = {
      {"empty", "", "f.csv:0"},
      {"no header", "trial,seed\n1,2\n", "f.csv:1"},
      {"columns missing", good.substr(0, first_line), "f.csv:1: the file ends"},
      {"other columns", good.substr(0, first_line) + "a,b\n", "f.csv:2"},
      {"short row", good + "2,7\n", "f.csv:9: 2 values, there are 4 columns"},
      {"trial out of range", good + "3,8,30,0.5\n", "f.csv:9: trial = 3"},
      {"cut in its last line", good.substr(0, good.size() - 3), "f.csv:8: the file is cut off"},
      {"trial missing", good.substr(0, good.find("\n2,") + 1), "trial 2 has no row"},
      {"trial no number", good + "x,8,30,0.5\n", "f.csv:9: trial = x"},
  };
  for (const Row& row : table) {
    const auto parsed = ParseTrialFile(row.text, "f.csv");
    ASSERT_FALSE(parsed) << row.name;
    EXPECT_NE(parsed.error().message.find(row.says), std::string::npos) << parsed.error().message;
  }
}

TEST(TrialTable, MutatedFilesNeverCrash) {
  const std::string good = TrialFileText(RunShard(6, {1, 2}));
  RandomStream random(11);
  int refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    std::string text = good;
    for (int edit = 0; edit < 3; ++edit) {
      const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(text.size())));
      if (random.Uniform() < 0.3) {
        text.resize(at + 1);
      } else {
        text[at] = static_cast<char>(random.Index(256));
      }
    }
    refused += ParseTrialFile(text, "f.csv").ok() ? 0 : 1;
  }
  EXPECT_GT(refused, 100) << "seed 11";
}

TEST(TrialTable, ShardTexts) {
  EXPECT_EQ(*ParseShard("2/4"), (Shard{2, 4}));
  for (const char* bad :
       {"", "2", "0/4", "5/4", "2/0", "-1/4", "a/4", "2/4x", "1/10001", "2 / 4"}) {
    EXPECT_FALSE(ParseShard(bad)) << bad;
  }
}

TEST(TrialTable, ColumnsAreReadByName) {
  const TrialTable table = RunShard(4, {1, 1}).table;
  EXPECT_EQ(table.Values("altitude_ft"), (std::vector<std::string>{"30", "70"}));
  EXPECT_EQ(table.Where("altitude_ft", "70").rows.size(), 4u);
  EXPECT_EQ(table.WhereNot("altitude_ft", "70").rows, table.Where("altitude_ft", "30").rows);
  EXPECT_EQ(table.Numbers("trial"), (std::vector<double>{0, 0, 1, 1, 2, 2, 3, 3}));
  EXPECT_EQ(table.Sum("trial"), 12);
  TrialTable odd{{"trial", "v"}, {{"0", "nan"}, {"1", "word"}, {"2", "1e3"}}};
  EXPECT_TRUE(std::isnan(odd.Numbers("v")[0]));
  EXPECT_TRUE(std::isnan(odd.Sum("v")));
  EXPECT_TRUE(std::isnan(odd.Numbers("v")[1]));
  EXPECT_EQ(odd.Numbers("v")[2], 1000);
}

TEST(TrialTable, NumbersSurviveTheFile) {
  EXPECT_EQ(CsvNumber(0.1), "0.1");
  EXPECT_EQ(CsvNumber(NAN), "nan");
  EXPECT_EQ(CsvNumber(-INFINITY), "-inf");
}

}  // namespace
}  // namespace palace
