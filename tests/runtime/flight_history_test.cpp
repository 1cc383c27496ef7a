// The planned path in the history: down the line of sight, level over the site, straight down.
#include "engine/runtime/flight_history.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/flight/glide_slope.h"

namespace palace {
namespace {

const GlideSlope kSlope{{12, -3, 0.4}, Rad(30), Rad(45), {0.9, 0, 0.3}};

EngineSnapshot FlyingAt(const Eigen::Vector3d& p_WB, VehicleMode mode) {
  EngineSnapshot snap;
  auto rig = std::make_shared<StereoRig>();
  rig->position_body_m = kSlope.p_BC;
  snap.rig = rig;
  snap.mission.state = MissionState::kDescending;
  LandingSite site;
  site.p_WS = kSlope.p_WS;
  snap.mission.armed = site;
  Approval approval;
  approval.p_WS = kSlope.p_WS;
  approval.approach_heading_rad = kSlope.heading_rad;
  approval.glide_slope_rad = kSlope.slope_rad;
  snap.mission.approval = approval;
  VehicleStatus vehicle;
  vehicle.mode = mode;
  snap.vehicle = vehicle;
  VehiclePose pose;
  pose.X_WB = {kSlope.LevelRotation(), p_WB};
  snap.pose = pose;
  return snap;
}

HistorySample SampleAt(const Eigen::Vector3d& p_WB, VehicleMode mode = VehicleMode::kDescend) {
  return SampleOf(FlyingAt(p_WB, mode), FrameBundle{});
}

TEST(FlightHistoryPath, DeviationIsTheDistanceFromTheWholePath) {
  const Eigen::Vector3d right = kSlope.LevelRotation().col(1);
  const Eigen::Vector3d halfway =
      (kSlope.BodyAt(kSettleHeight_m) + kSlope.BodyAboveSite(kSettleHeight_m)) / 2;
  const struct {
    const char* where;
    Eigen::Vector3d p_WB;
    double plan_height_m;
  } rows[] = {{"high on the slope", kSlope.BodyAt(20), 20},
              {"low on the slope", kSlope.BodyAt(5), 5},
              {"level leg", halfway, kSettleHeight_m},
              {"above the site", kSlope.BodyAboveSite(kSettleHeight_m), kSettleHeight_m},
              {"sinking", kSlope.BodyAboveSite(0.7), 0.7}};
  for (const auto& row : rows) {
    const HistorySample on = SampleAt(row.p_WB);
    EXPECT_NEAR(on.glide_deviation_m, 0, 1e-9) << row.where;
    EXPECT_NEAR(on.plan_height_m, row.plan_height_m, 1e-9) << row.where;
    const HistorySample off = SampleAt(row.p_WB + 0.6 * right);
    EXPECT_NEAR(off.glide_deviation_m, 0.6, 1e-9) << row.where;
    EXPECT_NEAR(off.plan_height_m, row.plan_height_m, 1e-9) << row.where;
  }
}

TEST(FlightHistoryPath, IsUnknownWhileThePathIsNotFlown) {
  for (const VehicleMode mode : {VehicleMode::kAlign, VehicleMode::kHold, VehicleMode::kLanded}) {
    const HistorySample sample = SampleAt(kSlope.BodyAt(10), mode);
    EXPECT_TRUE(std::isnan(sample.glide_deviation_m));
    EXPECT_TRUE(std::isnan(sample.plan_height_m));
  }
}

TEST(FlightHistoryPath, TheLaserReadsAsHeightOfTheSkids) {
  EngineSnapshot snap = FlyingAt(kSlope.BodyAt(10), VehicleMode::kDescend);
  snap.X_WC = snap.pose->X_WB * snap.rig->X_BC();
  FrameBundle bundle;
  LaserRange laser;
  const Eigen::Vector3d beam = snap.X_WC.R.col(2);
  laser.range_m = (kSlope.p_WS.z() - snap.X_WC.p.z()) / beam.z();  // level ground at the site
  bundle.laser.push_back(laser);
  EXPECT_NEAR(SampleOf(snap, bundle).laser_m, 10, 1e-9);
}

}  // namespace
}  // namespace palace
