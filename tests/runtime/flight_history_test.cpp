// One sample of the history: the mission's path, and the laser as height of the skids.
#include "engine/runtime/flight_history.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/flight/flight_path.h"

namespace palace {
namespace {

const FlightPath kPath{{12, -3, 0.4}, Rad(30), Rad(45), {0.9, 0, 0.3}, Lander{}.skid_centre_B()};

EngineSnapshot FlyingAt(const Eigen::Vector3d& p_WB, VehicleMode mode) {
  EngineSnapshot snap;
  auto rig = std::make_shared<StereoRig>();
  rig->position_body_m = kPath.p_BC;
  snap.sensors.Edit().rig = rig;
  snap.flight.Edit().mission.state = MissionState::kDescending;
  LandingSite site;
  site.p_WS = kPath.p_WS;
  snap.flight.Edit().mission.armed = site;
  Approval approval;
  approval.p_WS = kPath.p_WS;
  approval.approach_heading_rad = kPath.heading_rad;
  approval.glide_slope_rad = kPath.slope_rad;
  snap.flight.Edit().mission.approval = approval;
  VehicleStatus vehicle;
  vehicle.mode = mode;
  snap.sensors.Edit().vehicle = vehicle;
  VehiclePose pose;
  pose.X_WB = {kPath.LevelRotation(), p_WB};
  snap.sensors.Edit().pose = pose;
  return snap;
}

TEST(FlightHistoryPath, IsTheMissions) {
  EngineSnapshot snap = FlyingAt(kPath.BodyAt(10), VehicleMode::kDescend);
  EXPECT_TRUE(std::isnan(SampleOf(snap, FrameBundle{}).glide_deviation_m));
  EXPECT_TRUE(std::isnan(SampleOf(snap, FrameBundle{}).plan_height_m));
  snap.flight.Edit().mission.path = {9.5, 0.25, {}};
  EXPECT_EQ(SampleOf(snap, FrameBundle{}).glide_deviation_m, 0.25);
  EXPECT_EQ(SampleOf(snap, FrameBundle{}).plan_height_m, 9.5);
}

// Uncertainty grows and never vanishes; a place that nobody measured for long is no place.
TEST(FlightHistory, AnEstimateThatCoastedForTooLongIsABandWithoutALine) {
  EngineSnapshot snap = FlyingAt(kPath.BodyAt(10), VehicleMode::kDescend);
  FilterStatus& gps = snap.flight.Edit().navigation.gps;
  gps.running = true;
  gps.estimate.p_WB = {1, 2, -3};
  gps.estimate.sigma_p_m = {9, 9, 12};
  gps.coasting_s = 4;
  EXPECT_EQ(SampleOf(snap, FrameBundle{}).estimate_p_WB.z(), -3);
  gps.coasting_s = 6;
  const HistorySample sample = SampleOf(snap, FrameBundle{});
  EXPECT_TRUE(std::isnan(sample.estimate_p_WB.z()));
  EXPECT_TRUE(std::isnan(sample.descent_rate_mps));
  EXPECT_EQ(sample.estimate_sigma_m.z(), 12);
}

// Silence: what the last word said of the motion is no measurement of what came after.
TEST(FlightHistory, WhileTheVehicleIsSilentNoLineGoesOn) {
  EngineSnapshot snap = FlyingAt(kPath.BodyAt(10), VehicleMode::kDescend);
  FilterStatus& gps = snap.flight.Edit().navigation.gps;
  gps.running = true;
  gps.estimate.p_WB = {1, 2, -3};
  gps.estimate.sigma_p_m = {1, 1, 2};
  gps.coasting_s = 1.2;
  snap.flight.Edit().mission.height_above_site_m = 9;
  const auto heard = [&](double age_s) {
    snap.sensors.Edit().channels = {
        {ChannelId::kVehiclePose, ChannelHealth::State::kStale, age_s, 0, 50, 1, 0, ""},
        {ChannelId::kImu, ChannelHealth::State::kStale, age_s, 0, 200, 1, 0, ""},
        {ChannelId::kLaserRange, ChannelHealth::State::kNever, NAN, 0, 20, 0, 0, ""}};
    return SampleOf(snap, FrameBundle{});
  };
  EXPECT_EQ(heard(0.9).height_above_site_m, 9);
  EXPECT_EQ(heard(0.9).estimate_p_WB.z(), -3);
  const HistorySample silent = heard(1.1);
  for (const double value : {silent.estimate_p_WB.z(), silent.descent_rate_mps,
                             silent.height_above_site_m, silent.from_site_m, silent.gps_p_WB.z()}) {
    EXPECT_TRUE(std::isnan(value));
  }
  EXPECT_EQ(silent.estimate_sigma_m.z(), 2) << "the band goes on";
  snap.sensors.Edit().channels.clear();  // pictures alone: nobody is silent
  EXPECT_EQ(SampleOf(snap, FrameBundle{}).estimate_p_WB.z(), -3);
}

TEST(FlightHistoryPath, EveryHeightIsOfTheSkidsAboveTheSite) {
  EngineSnapshot snap = FlyingAt(kPath.BodyAt(10), VehicleMode::kDescend);
  FilterStatus& gps = snap.flight.Edit().navigation.gps;
  gps.running = true;
  gps.estimate.p_WB = snap.sensors->pose->X_WB.p + Eigen::Vector3d(1, 0, -2);
  Truth truth;
  truth.X_WB = snap.sensors->pose->X_WB;
  truth.X_WB.p.z() += 0.5;
  snap.sensors.Edit().truth = truth;
  snap.flight.Edit().mission.height_above_site_m = 11.9;
  snap.flight.Edit().mission.distance_to_site_m = 3.5;
  const HistorySample sample = SampleOf(snap, FrameBundle{});
  EXPECT_EQ(sample.height_above_site_m, 11.9);  // the very number that the mission tells
  EXPECT_EQ(sample.from_site_m, 3.5);
  EXPECT_NEAR(sample.gps_height_m, 12, 1e-9);
  EXPECT_NEAR(sample.truth_height_m, 9.5, 1e-9);
}

TEST(FlightHistoryPath, TheCentreIsLimitedWhileItsRowIsEnforced) {
  EngineSnapshot snap = FlyingAt(kPath.BodyAt(1), VehicleMode::kSink);
  EXPECT_FALSE(SampleOf(snap, FrameBundle{}).centre_limited);
  snap.flight.Edit().mission.limits = {
      {.id = LimitId::kFromCentre, .limit = 0.5, .enforced_by = EnforcedBy::kAlarm}};
  EXPECT_TRUE(SampleOf(snap, FrameBundle{}).centre_limited);
  snap.flight.Edit().mission.limits[0].enforced_by = EnforcedBy::kNobody;
  EXPECT_FALSE(SampleOf(snap, FrameBundle{}).centre_limited);
}

TEST(FlightHistoryPath, TheLaserReadsAsHeightOfTheSkids) {
  EngineSnapshot snap = FlyingAt(kPath.BodyAt(10), VehicleMode::kDescend);
  snap.sensors.Edit().X_WC = snap.sensors->pose->X_WB * snap.sensors->rig->X_BC();
  FrameBundle bundle;
  LaserRange laser;
  const Eigen::Vector3d beam = snap.sensors->X_WC.R.col(2);
  laser.range_m =
      (kPath.p_WS.z() - snap.sensors->X_WC.p.z()) / beam.z();  // level ground at the site
  laser.time = AddSeconds(snap.time, -0.04);
  bundle.laser.push_back(laser);
  EXPECT_NEAR(SampleOf(snap, bundle).laser_m, 10, 1e-9);
  EXPECT_EQ(SampleOf(snap, bundle).laser_time, laser.time);
  // Without pictures, and with a position that nobody knows any more.
  snap.sensors.Edit().X_WC = {};
  snap.flight.Edit().navigation.gps.running = true;
  snap.flight.Edit().navigation.gps.coasting_s = 60;
  EXPECT_TRUE(std::isnan(SampleOf(snap, bundle).estimate_p_WB.z()));
  EXPECT_NEAR(SampleOf(snap, bundle).laser_m, 10, 1e-9);
}

TEST(FlightHistory, TheHeightIsThatAboveTheSiteInQuestionBeforeOneIsSelected) {
  EngineSnapshot snap = FlyingAt(kPath.BodyAt(10), VehicleMode::kHover);
  snap.flight.Edit().mission.armed.reset();
  snap.flight.Edit().mission.height_above_site_m = 19.5;
  snap.flight.Edit().mission.distance_to_site_m = 7;
  snap.flight.Edit().mission.site_p_WS = {1, 2, 3};
  EXPECT_EQ(SampleOf(snap, FrameBundle{}).p_WS, Eigen::Vector3d(1, 2, 3))
      << "whose lines are drawn";
  EXPECT_EQ(SampleOf(snap, FrameBundle{}).height_above_site_m, 19.5);
  EXPECT_EQ(SampleOf(snap, FrameBundle{}).from_site_m, 7);
}

}  // namespace
}  // namespace palace
