// Alarms: three samples to come and to go; a cause must end before an alarm disappears (I15).
#include "engine/mission/alarms/alarms.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/text.h"
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

TEST(Alarms, OfWhatIsOverTheNewestStandsFirstAndBehindWhatStands) {
  AlarmBoard board;
  Timestamp now{0};
  const auto feed = [&](AlarmId id, bool present) {
    for (int sample = 0; sample < 4; ++sample) {
      now = AddSeconds(now, 0.1);
      board.Update({{id, AlarmLevel::kCaution, present, "Over."}}, now);
    }
  };
  for (const AlarmId id : {AlarmId::kLink, AlarmId::kOffPath, AlarmId::kHold}) {
    feed(id, true);
    feed(id, false);
  }
  feed(AlarmId::kCameraLeft, true);
  std::vector<AlarmId> order;
  for (const Alarm& alarm : board.Shown()) {
    order.push_back(alarm.kind);
  }
  EXPECT_EQ(order, (std::vector<AlarmId>{AlarmId::kCameraLeft, AlarmId::kHold, AlarmId::kOffPath,
                                         AlarmId::kLink}));
}

TEST(Alarms, OfWhatStandsTheNewestThatNobodyAnsweredStandsFirst) {
  AlarmBoard board;
  Timestamp now{0};
  std::vector<AlarmCondition> standing;
  const auto add = [&](AlarmId id, AlarmLevel level) {
    standing.push_back({id, level, true, "Stands."});
    for (int sample = 0; sample < 4; ++sample) {
      now = AddSeconds(now, 0.1);
      board.Update(standing, now);
    }
  };
  const auto order = [&] {
    std::vector<AlarmId> ids;
    for (const Alarm& alarm : board.Shown()) {
      ids.push_back(alarm.kind);
    }
    return ids;
  };
  add(AlarmId::kEnergyLow, AlarmLevel::kCaution);
  add(AlarmId::kImageTime, AlarmLevel::kWarning);
  add(AlarmId::kHold, AlarmLevel::kCaution);
  add(AlarmId::kCameraBlank, AlarmLevel::kCaution);
  EXPECT_EQ(order(), (std::vector<AlarmId>{AlarmId::kImageTime, AlarmId::kCameraBlank,
                                           AlarmId::kHold, AlarmId::kEnergyLow}));
  EXPECT_TRUE(board.Acknowledge(AlarmId::kCameraBlank));
  EXPECT_EQ(order(), (std::vector<AlarmId>{AlarmId::kImageTime, AlarmId::kHold, AlarmId::kEnergyLow,
                                           AlarmId::kCameraBlank}));
}

/// Off the path by so much; NaN: not beyond the limit.
void FeedFigures(AlarmBoard& board, std::initializer_list<double> figures, bool less = false) {
  for (const double figure : figures) {
    const std::string words = WithNumbers("%.2f m", figure);
    board.Update({{AlarmId::kOffPath, AlarmLevel::kCaution, std::isfinite(figure),
                   "Off by " + words + ", limit 0.30 m.", false, figure, less, words}},
                 {});
  }
}

TEST(Alarms, KeepTheirWorstFigureAndWhenTheyAreOverTheWordsOfThatSample) {
  for (const bool less : {false, true}) {
    SCOPED_TRACE(less);
    AlarmBoard board;
    const double worst = less ? 0.31 : 0.62;
    FeedFigures(board, {0.4, 0.4, 0.4, 0.45, worst, 0.35}, less);
    ASSERT_EQ(board.Shown().size(), 1U);
    EXPECT_EQ(board.Shown()[0].text, "Off by 0.35 m, limit 0.30 m.") << "while it stands, what is";
    EXPECT_EQ(board.Shown()[0].worst, WithNumbers("%.2f m", worst));
    FeedFigures(board, {NAN, NAN, NAN, NAN}, less);
    EXPECT_EQ(board.Shown()[0].text, "Off by " + board.Shown()[0].worst + ", limit 0.30 m.");
    // It comes again before anybody answered: the worst of both.
    FeedFigures(board, {0.4, 0.4, 0.4, NAN, NAN, NAN}, less);
    EXPECT_EQ(board.Shown()[0].count, 2);
    EXPECT_EQ(board.Shown()[0].worst, WithNumbers("%.2f m", worst));
    EXPECT_TRUE(board.Acknowledge(AlarmId::kOffPath));
    FeedFigures(board, {0.4, 0.4, 0.4}, less);
    EXPECT_EQ(board.Shown()[0].worst, "0.40 m") << "begun anew";
  }
}

// A jump that goes back ends in a sample of a few centimetres, which explains nothing.
TEST(Alarms, WhatNoLimitRaisesIsOverInTheWordsOfItsWorst) {
  AlarmFacts facts;
  facts.has_vehicle = true;
  AlarmBoard board;
  for (const double off_m : {3.1, 3.4, 0.2}) {
    facts.gps_agreement = {.off = true, .drifts = false, .off_m = off_m};
    board.Update(EvaluateAlarms(facts), {});
  }
  facts.gps_agreement.off = false;
  for (int i = 0; i < 4; ++i) {
    board.Update(EvaluateAlarms(facts), {});
  }
  const std::vector<Alarm> shown = board.Shown();
  const auto jump = std::find_if(shown.begin(), shown.end(), [](const Alarm& alarm) {
    return alarm.kind == AlarmId::kGpsJump;
  });
  ASSERT_NE(jump, shown.end());
  EXPECT_FALSE(jump->active);
  EXPECT_EQ(jump->text.rfind("GPS is 3.4 m off", 0), 0U) << jump->text;
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
  Feed(board, {false, false, false}, AlarmLevel::kWarning);
  EXPECT_EQ(board.UnacknowledgedWarning(), "Link 1.2 s, limit 1.0 s (over)");
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
