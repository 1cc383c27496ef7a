// The way down to the armed site: planned once, shown, signed, and followed on the way.
#include <cmath>

#include "engine/flight/flight_path.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

void Descend(MissionRig& rig) {
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
}

TEST(Approach, IsFrozenWithTheSiteAndSignedAsShown) {
  MissionRig rig;
  rig.settings.mission.descent_rate_mps = 0.8;
  EXPECT_FALSE(rig.mission.status().approach.has_value());
  rig.Arm();
  ASSERT_TRUE(rig.mission.status().approach.has_value());
  const ApproachPlan shown = *rig.mission.status().approach;
  EXPECT_NEAR(shown.heading_rad, StraightHeading(rig.p_WB(), {10, 2, 0}), 1e-12);
  EXPECT_EQ(shown.descent_rate_mps, 0.8);
  EXPECT_NEAR(shown.glide_slope_rad, Rad(90), 1e-12);
  rig.east_m += 0.4;  // a hover drifts: what was shown stays what is signed
  rig.Run(0.5);
  EXPECT_EQ(rig.mission.status().approach->heading_rad, shown.heading_rad);
  ASSERT_TRUE(rig.ApproveNow().ok());
  const Approval& approval = *rig.mission.status().approval;
  EXPECT_EQ(approval.approach_heading_rad, shown.heading_rad);
  EXPECT_EQ(approval.glide_slope_rad, shown.glide_slope_rad);
  EXPECT_EQ(approval.descent_rate_mps, shown.descent_rate_mps);
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 10));
  EXPECT_FALSE(rig.mission.status().approach.has_value());  // the next site has its own
}

TEST(Approach, IsPlannedOnceTheVehiclesPlaceIsKnown) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  rig.east_m = NAN;
  rig.Step();
  ASSERT_TRUE(rig.Do(SelectSite{101}).ok());
  rig.Run(1.5);
  EXPECT_FALSE(rig.mission.status().approach.has_value());
  EXPECT_FALSE(rig.ApproveNow().ok());
  rig.east_m = 2;
  rig.Run(0.2);
  EXPECT_TRUE(rig.mission.status().approach.has_value());
  EXPECT_TRUE(rig.ApproveNow().ok());
}

// Site A, 10 m north and 2 m east; the vehicle 20 m above and 9 m south of it, looking north. The
// small vehicle flies where the test puts it.
class TurnedApproach : public ::testing::Test {
 protected:
  TurnedApproach() {
    rig.settings.mission.glide_slope_deg = 45;
    rig.north_m = 1;
    rig.Site(101)->corridor_clear = false;
    rig.Site(101)->clear_approaches = 1U << 2;  // who comes from the east flies west
  }
  void Arm() {
    ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
    ASSERT_TRUE(rig.Do(SelectSite{101}).ok());
    rig.Site(101)->corridor_clear = true;  // so the maps judge the planned corridor
    rig.Run(1.5);
  }
  void Approve() {
    Arm();
    ASSERT_TRUE(rig.ApproveNow().ok()) << rig.mission.status().cannot_approve_reason;
    ASSERT_TRUE(rig.RunUntil(MissionState::kApproved, 1));
    StayOnTheWay();
  }
  void StayOnTheWay() {
    rig.Step();
    rig.vehicle.mode_for_s = -100;
    rig.Step();
  }
  MissionRig rig;
};

TEST_F(TurnedApproach, IsPlannedShownAndSigned) {
  ASSERT_NO_FATAL_FAILURE(Arm());
  const MissionStatus& status = rig.mission.status();
  ASSERT_TRUE(status.approach.has_value());
  EXPECT_TRUE(status.approach->turned());
  EXPECT_NEAR(std::abs(WrapAngle(status.approach->heading_rad - Rad(-90))), 0, 1e-9);
  EXPECT_EQ(FindLimit(status.armed_limits, LimitId::kApproach)->value, 0);
  bool told = false;
  for (const Event& event : rig.mission.events()) {
    told = told || event.text ==
                       "ARMED: Site A selected, approached from the east: the straight way is "
                       "blocked";
  }
  EXPECT_TRUE(told);
  ASSERT_TRUE(rig.ApproveNow().ok()) << status.cannot_approve_reason;
  EXPECT_EQ(status.approval->approach_heading_rad, status.approach->heading_rad);
  const double lasts_s = SecondsBetween(status.approval->approved_at, status.approval->expires_at);
  EXPECT_GT(lasts_s, rig.settings.mission.approval_expiry_s + 10);  // some 22 m of way
  EXPECT_LE(lasts_s, 120);
}

TEST_F(TurnedApproach, BlockedOnThePlannedCourseIsNotApproved) {
  ASSERT_NO_FATAL_FAILURE(Arm());
  rig.Site(101)->corridor_clear = false;
  rig.Run(0.3);
  EXPECT_FALSE(rig.mission.status().can_approve);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, "Approach to site A is blocked");
}

TEST_F(TurnedApproach, VisionWaitsUntilTheVehicleLooksAtTheSiteFromThere) {
  ASSERT_NO_FATAL_FAILURE(Approve());
  EXPECT_FALSE(rig.mission.WantsTracking());
  EXPECT_FALSE(rig.mission.VisionAllowed());
  EXPECT_EQ(rig.state(), MissionState::kApproved);
  const FlightPath path = PathTo(rig.mission.memory(), *rig.mission.status().armed);
  const Eigen::Vector3d start = path.Start(rig.p_WB());
  rig.north_m = start.x();
  rig.east_m = start.y();
  StayOnTheWay();
  EXPECT_FALSE(rig.mission.WantsTracking()) << "it is there, and looks elsewhere";
  rig.yaw_rad = path.heading_rad;
  StayOnTheWay();
  EXPECT_TRUE(rig.mission.WantsTracking());
  EXPECT_TRUE(rig.mission.VisionAllowed());
}

// It looks away on purpose: that its ground was not seen meanwhile is no alarm; at the end it is.
TEST_F(TurnedApproach, NotToSeeTheSiteOnTheWayRoundIsNoDoubt) {
  ASSERT_NO_FATAL_FAILURE(Approve());
  rig.ground_age_s = 7;
  for (int i = 0; i < 5; ++i) {
    StayOnTheWay();
  }
  EXPECT_EQ(rig.mission.status().armed_verdict, SiteVerdict::kHolds);
  const FlightPath path = PathTo(rig.mission.memory(), *rig.mission.status().armed);
  rig.yaw_rad = path.heading_rad;
  rig.north_m = path.Start(rig.p_WB()).x();
  rig.east_m = path.Start(rig.p_WB()).y();
  for (int i = 0; i < 5; ++i) {
    StayOnTheWay();
  }
  EXPECT_EQ(rig.mission.status().armed_verdict, SiteVerdict::kDegraded);
}

// Why a descent was stopped stays to be read while another site is looked for.
TEST(Approach, TheReasonOfAHoldOutlivesIt) {
  MissionRig rig;
  Descend(rig);
  rig.Site(101)->corridor_clear = false;
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, 2));
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed, 10));
  EXPECT_EQ(rig.mission.status().selection_ended,
            "Landing on site A stopped: Something stands in the approach.");
}

// Seen from where it begins the corridor may be another matter.
TEST_F(TurnedApproach, WhatStandsInItEndsTheApproval) {
  ASSERT_NO_FATAL_FAILURE(Approve());
  rig.Site(101)->corridor_clear = false;
  for (int i = 0; i < 5; ++i) {
    StayOnTheWay();
  }
  EXPECT_EQ(rig.state(), MissionState::kHold);
  EXPECT_EQ(rig.mission.status().why, "Something stands in the approach");
}

TEST(Approach, AStraightOneIsTrackedAllTheWay) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  rig.yaw_rad = Rad(120);
  rig.Step();
  ASSERT_EQ(rig.state(), MissionState::kApproved);
  EXPECT_TRUE(rig.mission.WantsTracking());
}

TEST(PathProgress, IsPublishedWhileThePathIsFlown) {
  MissionRig rig;
  Descend(rig);
  rig.Step();
  const MissionStatus& status = rig.mission.status();
  EXPECT_NEAR(status.path.off_path_m, 0.5, 1e-9);
  EXPECT_FALSE(status.path.ahead.empty());
  EXPECT_GT(status.time_to_touchdown_s, 0);
  for (const VehicleMode mode : {VehicleMode::kAlign, VehicleMode::kLanded}) {
    rig.vehicle.Set(mode);
    rig.Step();
    EXPECT_TRUE(std::isnan(status.path.off_path_m));
    EXPECT_TRUE(status.path.ahead.empty());
  }
}

}  // namespace
}  // namespace palace
