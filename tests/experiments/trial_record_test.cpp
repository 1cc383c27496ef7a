// Trials that are kept as they are done, and what a run that goes on takes of them.
#include "engine/experiments/trial_record.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

class Trials : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  ~Trials() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Result<TrialRecord> Open(bool resume) const {
    return TrialRecord::Open(path_, {header_, {"height, m", "verdict"}, inputs_}, resume);
  }
  void Keep(TrialRecord& record, int trial, TrialRecord::Rows rows) const {
    EXPECT_TRUE(record.Add(trial, std::move(rows)));
  }
  std::string Text() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const fs::path folder_ = OwnPath("");
  const fs::path path_ = folder_ / "ground.trials";
  TrialHeader header_ = {"ground", "heights 8,15", 7, 40, {1, 1}};
  std::string inputs_ = " files 3f2a9c";
};

TEST_F(Trials, AreTakenUpAgainWithAllTheirRowsAndNoneThatWasCutOff) {
  {
    Result<TrialRecord> record = Open(false);
    ASSERT_TRUE(record);
    EXPECT_EQ(record->done_count(), 0);
    Keep(*record, 0, {{"8", "safe"}, {"15", ""}});
    Keep(*record, 2, {});
  }
  std::ofstream(path_, std::ios::app) << "8,safe\n15,uns";  // of trial 3, when it was killed
  {
    Result<TrialRecord> again = Open(true);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->done_count(), 2);
    ASSERT_NE(again->Done(0), nullptr);
    EXPECT_EQ(*again->Done(0), (TrialRecord::Rows{{"8", "safe"}, {"15", ""}}));
    ASSERT_NE(again->Done(2), nullptr);
    EXPECT_TRUE(again->Done(2)->empty());
    EXPECT_EQ(again->Done(1), nullptr);
    EXPECT_EQ(again->Done(3), nullptr);
    Keep(*again, 3, {{"8", "look"}});
  }
  const Result<TrialRecord> third = Open(true);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->done_count(), 3);
  EXPECT_EQ(*third->Done(3), (TrialRecord::Rows{{"8", "look"}}));
}

TEST_F(Trials, AreNotThrownAwayBecauseTheFlagWasForgotten) {
  {
    Result<TrialRecord> record = Open(false);
    ASSERT_TRUE(record);
    Keep(*record, 0, {{"8", "safe"}});
  }
  const std::string before = Text();
  const Result<TrialRecord> anew = Open(false);
  ASSERT_FALSE(anew);
  EXPECT_EQ(anew.error().code, ErrorCode::kUsage);
  EXPECT_NE(anew.error().message.find("--resume goes on"), std::string::npos);
  EXPECT_EQ(Text(), before);
}

TEST_F(Trials, GoWhenAllOfThemAreWrittenAndStayWhenMoreAreKept) {
  Result<TrialRecord> record = Open(false);
  ASSERT_TRUE(record);
  Keep(*record, 0, {{"8", "safe"}});
  Keep(*record, 3, {{"8", "look"}});
  record->Finish(3);
  EXPECT_TRUE(fs::exists(path_));
  record = Open(true);
  ASSERT_TRUE(record);
  record->Finish(4);
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Trials, OfAnotherRunAreRefusedAndLeftAsTheyAre) {
  {
    Result<TrialRecord> record = Open(false);
    ASSERT_TRUE(record);
    Keep(*record, 0, {{"8", "safe"}});
  }
  const std::string before = Text();
  const TrialHeader own = header_;
  TrialHeader others[] = {own, own, own, own};
  others[0].seed = 8;
  others[1].setup = "heights 8";
  others[2].shard = {2, 3};
  others[3].experiment = "things";
  for (const TrialHeader& other : others) {
    header_ = other;
    const Result<TrialRecord> refused = Open(true);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
    EXPECT_NE(refused.error().message.find("another run"), std::string::npos);
  }
  header_ = own;
  inputs_ = " files 000000";  // a file was edited
  EXPECT_FALSE(Open(true));
  EXPECT_EQ(Text(), before);
  inputs_ = " files 3f2a9c";
  header_.trials = 400;  // a longer run of the same trials
  EXPECT_TRUE(Open(true));
}

TEST_F(Trials, WithALineOfAnotherWidthNameFileLineAndWidth) {
  { ASSERT_TRUE(Open(false)); }
  std::ofstream(path_, std::ios::app) << "8,safe\n8,safe,more\n# trial 0 done\n";
  const Result<TrialRecord> refused = Open(true);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find(path_.string() + ":3: 3 values, there are 2 columns"),
            std::string::npos)
      << refused.error().message;
}

TEST_F(Trials, ThatWereEditedAreRefusedWithFileAndLine) {
  {
    Result<TrialRecord> record = Open(false);
    ASSERT_TRUE(record);
    Keep(*record, 0, {{"8", "safe"}});
    Keep(*record, 1, {{"8", "look"}});
  }
  const std::string text = Text();
  const auto row = text.find("8,safe\n"), end = text.find("8,look\n");
  const std::string first = text.substr(row, end - row);
  const std::string edits[] = {std::string(text).replace(row, 6, "8,look"),  // another value
                               std::string(text).insert(row, "8,safe\n"),    // a row twice
                               std::string(text).erase(row, 7),              // none
                               std::string(text).insert(end, first)};        // a trial twice
  for (const std::string& edit : edits) {
    std::ofstream(path_, std::ios::binary) << edit;
    const Result<TrialRecord> refused = Open(true);
    ASSERT_FALSE(refused) << edit;
    EXPECT_EQ(refused.error().message.find(path_.string() + ":"), 0u);
    EXPECT_NE(refused.error().message.find("trial 0"), std::string::npos)
        << refused.error().message;
  }
  std::ofstream(path_, std::ios::binary) << text;
  EXPECT_TRUE(Open(true));
}

TEST_F(Trials, ThatAnotherProgramWritesAreLeftToIt) {
  Result<TrialRecord> first = Open(false);
  ASSERT_TRUE(first);
  Keep(*first, 0, {{"8", "safe"}});
  for (const bool resume : {false, true}) {
    const Result<TrialRecord> second = Open(resume);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kUsage);
    EXPECT_NE(second.error().message.find("another run writes here now"), std::string::npos);
  }
  Keep(*first, 1, {{"8", "look"}});
  first->Finish(1);
  EXPECT_EQ(Open(true)->done_count(), 2);
}

TEST_F(Trials, SayWhereTheyCannotBeKept) {
  const Result<TrialRecord> refused =
      TrialRecord::Open(folder_ / "none" / "ground.trials", {header_}, false);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("cannot write"), std::string::npos);
}

}  // namespace
}  // namespace palace
