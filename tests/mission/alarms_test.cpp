// Alarms: three samples to come and to go; a cause must end before an alarm disappears (I15).
#include <gtest/gtest.h>

#include "engine/mission/alarms/alarm_board.h"

namespace palace {
namespace {

void Feed(AlarmBoard& board, std::initializer_list<bool> samples,
          AlarmLevel level = AlarmLevel::kCaution) {
  Timestamp now{0};
  for (const bool present : samples) {
    now = AddSeconds(now, 0.1);
    board.Update({{AlarmId::kLink, level, present, "Link 1.2 s, limit 1.0 s."}}, now);
  }
}

TEST(Alarms, ComesOnWithTheThirdSample) {
  AlarmBoard board;
  Feed(board, {true, true, false, true, true});
  EXPECT_TRUE(board.Shown().empty());
  Feed(board, {true});
  ASSERT_EQ(board.Shown().size(), 1U);
  EXPECT_TRUE(board.Shown()[0].active);
  EXPECT_EQ(board.raised().size(), 1U);
}

TEST(Alarms, AcknowledgingOnlySilences) {
  AlarmBoard board;
  Feed(board, {true, true, true});
  EXPECT_TRUE(board.Acknowledge(AlarmId::kLink));
  EXPECT_TRUE(board.IsAcknowledged(AlarmId::kLink));
  Feed(board, {true, true});
  ASSERT_EQ(board.Shown().size(), 1U);
  EXPECT_TRUE(board.Shown()[0].acknowledged);
  Feed(board, {false, false, false});
  EXPECT_TRUE(board.Shown().empty());
  EXPECT_FALSE(board.Acknowledge(AlarmId::kLink));
}

TEST(Alarms, ClearedButNotAcknowledgedStays) {
  AlarmBoard board;
  Feed(board, {true, true, true, false, false, false, false});
  ASSERT_EQ(board.Shown().size(), 1U);
  EXPECT_FALSE(board.Shown()[0].active);
  EXPECT_TRUE(board.Acknowledge(AlarmId::kLink));
  EXPECT_TRUE(board.Shown().empty());
}

TEST(Alarms, AdvisoriesGoWithTheirCause) {
  AlarmBoard board;
  Feed(board, {true, true, true, false, false, false}, AlarmLevel::kAdvisory);
  EXPECT_TRUE(board.Shown().empty());
}

TEST(Alarms, GrowingIntoAWarningAsksAgain) {
  AlarmBoard board;
  Feed(board, {true, true, true});
  board.Acknowledge(AlarmId::kLink);
  EXPECT_EQ(board.UnacknowledgedWarning(), "");
  Feed(board, {true}, AlarmLevel::kWarning);
  EXPECT_EQ(board.UnacknowledgedWarning(), "Link 1.2 s, limit 1.0 s.");
}

TEST(Alarms, WorstFirst) {
  AlarmBoard board;
  for (int i = 0; i < 3; ++i) {
    board.Update({{AlarmId::kExposure, AlarmLevel::kAdvisory, true, ""},
                  {AlarmId::kPose, AlarmLevel::kCaution, true, ""},
                  {AlarmId::kClock, AlarmLevel::kWarning, true, ""}},
                 {i});
  }
  const auto shown = board.Shown();
  ASSERT_EQ(shown.size(), 3U);
  EXPECT_EQ(shown[0].kind, AlarmId::kClock);
  EXPECT_EQ(shown[1].kind, AlarmId::kPose);
  EXPECT_EQ(shown[2].kind, AlarmId::kExposure);
}

// A warning that is over and not acknowledged must not hide a caution that stands.
TEST(Alarms, WhatStandsComesBeforeWhatIsOver) {
  AlarmBoard board;
  for (int i = 0; i < 6; ++i) {
    board.Update({{AlarmId::kPose, AlarmLevel::kCaution, true, ""},
                  {AlarmId::kClock, AlarmLevel::kWarning, i < 3, ""}},
                 {i});
  }
  const auto shown = board.Shown();
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0].kind, AlarmId::kPose);
  EXPECT_FALSE(shown[1].active);
}

}  // namespace
}  // namespace palace
