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
