// Whatever holds a descent by a figure is a row of Limits in force.
#include <gtest/gtest.h>

#include "tests/mission/measured_facts.h"

namespace palace {
namespace {

/// The row by which a descent holds for this alarm.
const LimitRow* HoldRow(const AlarmRow& row, const std::vector<LimitRow>& rows) {
  return row.hold.label == nullptr ? nullptr : FindLimit(rows, row.hold.id);
}

// Whatever stops by a number has a row in Limits in force, over exactly when the stop gives its
// reason.
TEST(HoldLimits, EachStopThatHasAFigureHasARowWithTheLimitThatStops) {
  int checked = 0;
  for (const AlarmRow& row : AlarmTable()) {
    SCOPED_TRACE(AlarmName(row.id));
    EXPECT_TRUE(row.stop == nullptr || row.value == nullptr || row.hold.label != nullptr)
        << "it stops by a figure, and no row shows it";
    if (row.hold.label == nullptr) {
      continue;
    }
    const double limit =
        row.hold.limit_from != nullptr ? AllMeasured().*row.hold.limit_from : row.hold.limit;
    for (const double share : {0.999, 1.001}) {
      AlarmFacts facts = AllMeasured();
      facts.invalid_for_s = facts.image_offset_ms = 0;
      facts.*row.hold.value = share * limit;
      facts.attitude_invalid_s = facts.invalid_for_s > 0 ? facts.invalid_for_s : NAN;
      facts.image_time = facts.image_offset_ms > row.hold.limit ? "Image time off" : "";
      facts.gravity = {facts.tilt_deg > GravityAgreement::kLimit_deg, facts.tilt_deg};
      const std::vector<LimitRow> rows = LimitsOfHolds(facts);
      ASSERT_NE(HoldRow(row, rows), nullptr);
      EXPECT_EQ(HoldRow(row, rows)->enforced_by, EnforcedBy::kHold);
      EXPECT_EQ(HoldRow(row, rows)->over, share > 1);
      EXPECT_EQ(HoldRow(row, rows)->limit, limit);
      // Of lost vision (transitions_test.cpp) and of a vehicle beside its site
      // (descent_limits_test.cpp) the state machine itself asks.
      const bool asked_there = row.id == AlarmId::kVisionLost || row.id == AlarmId::kOffCentre;
      EXPECT_EQ(row.stop != nullptr && !row.stop(facts).empty(), share > 1 && !asked_there);
    }
    ++checked;
  }
  EXPECT_EQ(checked, 11);
}

TEST(HoldLimits, NameWhoActsInEachState) {
  AlarmFacts facts = AllMeasured();
  facts.unconfirmed_height_m = 5;
  const auto by = [&](MissionState state, bool committed, LimitId id) {
    facts.state = state;
    facts.committed = committed;
    const std::vector<LimitRow> rows = LimitsOfHolds(facts);
    const LimitRow* row = FindLimit(rows, id);
    return row == nullptr ? "no row" : EnforcedByWord(row->enforced_by);
  };
  using State = MissionState;
  EXPECT_STREQ(by(State::kDescending, false, LimitId::kLeftCameraAge), "hold");
  EXPECT_STREQ(by(State::kDescending, true, LimitId::kLeftCameraAge), "for information");
  EXPECT_STREQ(by(State::kDescending, true, LimitId::kStatusAge), "hold");
  EXPECT_STREQ(by(State::kDescending, true, LimitId::kVisionOutage), "hold");
  EXPECT_STREQ(by(State::kHold, false, LimitId::kLeftCameraAge), "guard");
  EXPECT_STREQ(by(State::kSearch, false, LimitId::kLeftCameraAge), "no row");
  EXPECT_STREQ(by(State::kLanded, false, LimitId::kLeftCameraAge), "no row");
  facts.state = State::kDescending;
  const std::vector<LimitRow> rows = LimitsOfHolds(facts);
  EXPECT_TRUE(FindLimit(rows, LimitId::kConfirmHeight)->over) << "5 m, confirmed by 6 m";
}

}  // namespace
}  // namespace palace
