// Near the ground no approval is given over air that no picture has shown.
#include <cmath>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

struct Row {
  const char* name;
  double height_m;
  double air_seen_m;
  bool may_approve;
};

class LookFromAbove : public testing::TestWithParam<Row> {};

TEST_P(LookFromAbove, IsAskedBeforeAnApproval) {
  MissionRig rig;
  rig.vehicle.height_m = GetParam().height_m;
  rig.Site(101)->air_seen_m = GetParam().air_seen_m;
  rig.Arm();
  const MissionStatus& status = rig.mission.status();
  EXPECT_EQ(status.can_approve, GetParam().may_approve) << status.cannot_approve_reason;
  EXPECT_EQ(rig.ApproveNow().ok(), GetParam().may_approve);
}

INSTANTIATE_TEST_SUITE_P(, LookFromAbove,
                         testing::Values(Row{"NearAndHardlySeen", 7, 3.9, false},
                                         Row{"NearAndJustNotSeen", 9.9, 4.96, false},
                                         Row{"NearAndSeenFromHigherUp", 7, 5.0, true},
                                         Row{"HighEnoughToLookOnTheWay", 10.5, 3.9, true},
                                         Row{"NearAndNobodyAsked", 7, NAN, true}),
                         [](const auto& row) { return row.param.name; });

TEST(LookFromAboveWords, SayWhatWasSeenWhatIsAskedAndWhatToDo) {
  MissionRig rig;
  rig.vehicle.height_m = 7;
  rig.Site(101)->air_seen_m = 4.96;
  rig.Arm();
  EXPECT_EQ(rig.mission.status().cannot_approve_reason,
            "Air over the site seen up to 4.9 m, min 5.0 m from below 10 m: wave off to look from "
            "above");
}

TEST(LookFromAboveWords, WhatWasApprovedFromAboveIsFlownThrough) {
  MissionRig rig;
  rig.Site(101)->air_seen_m = 4;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  EXPECT_TRUE(rig.RunUntil(MissionState::kLanded, 60));
}

}  // namespace
}  // namespace palace
