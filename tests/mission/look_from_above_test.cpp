// No approval is given over air that no picture has shown, where the way down shows it neither.
#include <cmath>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

struct Row {
  const char* name;
  double height_m;
  double air_seen_m, air_on_way_m;
  bool may_approve;
};

class LookFromAbove : public testing::TestWithParam<Row> {};

TEST_P(LookFromAbove, IsAskedBeforeAnApproval) {
  MissionRig rig;
  rig.vehicle.height_m = GetParam().height_m;
  rig.Site(101)->air_seen_m = GetParam().air_seen_m;
  rig.Site(101)->air_on_way_m = GetParam().air_on_way_m;
  rig.Arm();
  const MissionStatus& status = rig.mission.status();
  EXPECT_EQ(status.can_approve, GetParam().may_approve) << status.cannot_approve_reason;
  EXPECT_EQ(rig.ApproveNow().ok(), GetParam().may_approve);
}

INSTANTIATE_TEST_SUITE_P(, LookFromAbove,
                         testing::Values(Row{"HardlySeen", 7, 3.9, 1.2, false},
                                         Row{"JustNotSeen", 9.9, 4.96, 4.96, false},
                                         Row{"SeenFromHigherUp", 7, 5.0, 1.2, true},
                                         Row{"SeenOnTheWay", 10.5, 3.9, 5.0, true},
                                         // A camera straight down, from 11.5 m.
                                         Row{"HighAndNotSeenOnTheWay", 11.5, 4.4, 4.5, false},
                                         Row{"NothingKnownOfTheWay", 15, 3.9, NAN, false},
                                         Row{"NobodyAsked", 7, NAN, NAN, true}),
                         [](const auto& row) { return row.param.name; });

// The vehicle leans in gusts, and what the way down shows with it: no check that comes and goes.
TEST(LookFromAboveWords, AreSettledByOneMapThatShowsTheAirOnTheWay) {
  MissionRig rig;
  rig.Site(101)->air_seen_m = 4;
  rig.Site(101)->air_on_way_m = 4.9;
  rig.Arm();
  const MissionStatus& status = rig.mission.status();
  EXPECT_FALSE(status.can_approve);
  EXPECT_TRUE(FindLimit(status.armed_limits, LimitId::kAirSeen)->over);
  for (const double on_way_m : {5.1, 4.9}) {
    rig.Site(101)->air_on_way_m = on_way_m;
    rig.Run(0.3);
    EXPECT_TRUE(status.can_approve) << on_way_m << " " << status.cannot_approve_reason;
    for (const auto& rows : {status.armed_limits, status.limits}) {
      EXPECT_FALSE(FindLimit(rows, LimitId::kAirSeen)->over) << on_way_m;
    }
  }
  ASSERT_TRUE(rig.Do(DisarmSite{}).ok());
  rig.Run(0.3);
  rig.Arm();
  EXPECT_FALSE(status.can_approve) << "of that selection";
}

TEST(LookFromAboveWords, SayWhatWasSeenWhatIsAskedAndWhatToDo) {
  MissionRig rig;
  rig.vehicle.height_m = 7;
  rig.Site(101)->air_seen_m = 4.96;
  rig.Site(101)->air_on_way_m = 1.28;
  rig.Arm();
  EXPECT_EQ(rig.mission.status().cannot_approve_reason,
            "Air over the site seen up to 4.9 m, on the way down up to 1.2 m, min 5.0 m: look "
            "from higher up");
}

TEST(LookFromAboveWords, WhatWasApprovedFromAboveIsFlownThrough) {
  MissionRig rig;
  rig.Site(101)->air_seen_m = 4;
  rig.Site(101)->air_on_way_m = 8;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  rig.Site(101)->air_on_way_m = 0;
  EXPECT_TRUE(rig.RunUntil(MissionState::kLanded, 60));
}

}  // namespace
}  // namespace palace
