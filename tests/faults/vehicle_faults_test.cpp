#include "engine/faults/vehicle_faults.h"

#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "tests/faults/fault_rig.h"

namespace palace {
namespace {

constexpr double kFrom_s = 0.5;

std::vector<FrameBundle> Struck(FaultKind kind, double value = NAN,
                                std::optional<ChannelId> channel = {}) {
  VehicleFaults faults(3);
  std::vector<FrameBundle> bundles;
  for (int i = 0; i < 20; ++i) {
    bundles.push_back(BundleOfEverything(i));
    faults.Apply(bundles.back(), {{kind, channel, value, kFrom_s}}, 0.1 * i + 1e-9);
  }
  return bundles;
}

double YawOf(const VehiclePose& pose) { return std::atan2(pose.X_WB.R(1, 0), pose.X_WB.R(0, 0)); }

TEST(VehicleFaults, NothingChangesBefore) {
  for (const FaultKindRow& row : FaultKindTable()) {
    const FrameBundle bundle = Struck(row.kind)[3], whole = BundleOfEverything(3);
    EXPECT_EQ(bundle.time, whole.time) << row.name;
    EXPECT_EQ(bundle.poses.size(), whole.poses.size()) << row.name;
    EXPECT_EQ(bundle.gps[0].p_WB, whole.gps[0].p_WB) << row.name;
    EXPECT_EQ(bundle.laser[1].range_m, whole.laser[1].range_m) << row.name;
    EXPECT_EQ(bundle.status->boot_id, whole.status->boot_id) << row.name;
  }
}

TEST(VehicleFaults, ShiftedAttitudeHasTheContentOfAnotherMoment) {
  for (const double shift_s : {-0.1, -0.05, 0.05, 0.1, 0.3}) {
    const FrameBundle bundle = Struck(FaultKind::kAttitudeShifted, shift_s)[15];
    ASSERT_TRUE(bundle.pose_at_exposure) << shift_s;
    EXPECT_EQ(bundle.pose_at_exposure->time, bundle.stereo->time);
    if (shift_s > 0) {  // nothing of the future is needed
      EXPECT_NEAR(YawOf(*bundle.pose_at_exposure), 0.5 * (1.5 - shift_s), 1e-9) << shift_s;
    }
    for (const VehiclePose& pose : bundle.poses) {
      EXPECT_NEAR(YawOf(pose), 0.5 * (SecondsBetween(kFlightStart, pose.time) - shift_s), 1e-9);
      EXPECT_LE(pose.time, bundle.time);
    }
    EXPECT_EQ(bundle.imu.back().time, bundle.time) << "only poses";
  }
}

TEST(VehicleFaults, LateAttitudeKeepsItsStampsAndLeavesNoPoseAtExposure) {
  const FrameBundle bundle = Struck(FaultKind::kAttitudeLate, 0.3)[15];
  EXPECT_FALSE(bundle.pose_at_exposure);
  ASSERT_EQ(bundle.poses.size(), 5u);
  EXPECT_NEAR(SecondsBetween(bundle.poses.back().time, bundle.time), 0.3, 1e-6);
  EXPECT_NEAR(YawOf(bundle.poses.back()), 0.5 * 1.2, 1e-9);
}

TEST(VehicleFaults, WithoutPosesThereIsNoneAtTheExposure) {
  EXPECT_FALSE(Struck(FaultKind::kAttitudeNan)[10].pose_at_exposure);
  EXPECT_FALSE(Struck(FaultKind::kMissing, NAN, ChannelId::kVehiclePose)[10].pose_at_exposure);
  EXPECT_TRUE(Struck(FaultKind::kMissing, NAN, ChannelId::kImu)[10].pose_at_exposure);
}

TEST(VehicleFaults, LaserStuckScaledAndWithSpikes) {
  const auto stuck = Struck(FaultKind::kLaserStuck);
  EXPECT_EQ(stuck[6].laser[0].range_m, stuck[19].laser[1].range_m);
  EXPECT_NE(stuck[6].laser[0].time, stuck[19].laser[1].time);
  EXPECT_DOUBLE_EQ(Struck(FaultKind::kLaserScaled, 0.5)[10].laser[0].range_m, 15.1 / 2);
}

TEST(VehicleFaults, OneRangeInTwentyIsASpike) {
  VehicleFaults faults(3);
  int spikes = 0, ranges = 0;
  for (int i = 0; i < 500; ++i) {
    FrameBundle bundle = BundleOfEverything(i);
    faults.Apply(bundle, {{.kind = FaultKind::kLaserSpikes, .value = 50}}, 0.1 * i);
    for (const LaserRange& range : bundle.laser) {
      spikes += range.range_m > 50 ? 1 : 0;
      ++ranges;
    }
  }
  EXPECT_NEAR(spikes, 0.05 * ranges, 4 * std::sqrt(0.05 * 0.95 * ranges));
}

TEST(VehicleFaults, GpsJumpsAndDrifts) {
  const GpsFix whole = BundleOfEverything(15).gps[0];
  const GpsFix jumped = Struck(FaultKind::kGpsJump, 8)[15].gps[0];
  EXPECT_NEAR((jumped.p_WB - whole.p_WB).x(), 8, 1e-12);
  EXPECT_EQ(jumped.v_WB, whole.v_WB);
  const GpsFix drifted = Struck(FaultKind::kGpsDrift, 2)[15].gps[0];
  EXPECT_NEAR((drifted.p_WB - whole.p_WB).x(), 2 * (1.45 - kFrom_s), 1e-6);
}

TEST(VehicleFaults, ABiasOfAttitudeRollsEveryPoseAndNothingElse) {
  const FrameBundle rolled = Struck(FaultKind::kAttitudeBias, 3)[10],
                    whole = BundleOfEverything(10);
  const auto roll_deg = [](const VehiclePose& biased, const VehiclePose& truth) {
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(truth.X_WB.R.transpose() * biased.X_WB.R));
    EXPECT_NEAR((turn.axis() - Eigen::Vector3d::UnitX()).norm(), 0, 1e-9) << "about B forward";
    return Deg(turn.angle());
  };
  for (std::size_t i = 0; i < whole.poses.size(); ++i) {
    EXPECT_NEAR(roll_deg(rolled.poses[i], whole.poses[i]), 3, 1e-9);
    EXPECT_EQ(rolled.poses[i].X_WB.p, whole.poses[i].X_WB.p);
  }
  EXPECT_NEAR(roll_deg(*rolled.pose_at_exposure, *whole.pose_at_exposure), 3, 1e-9);
  EXPECT_EQ(rolled.imu[2].angular_rate_B, whole.imu[2].angular_rate_B);
}

TEST(VehicleFaults, BiasesOfTheInertialUnitAreSteps) {
  const FrameBundle whole = BundleOfEverything(10);
  const FrameBundle turned = Struck(FaultKind::kImuGyroBias, 2)[10];
  const FrameBundle pushed = Struck(FaultKind::kImuAccelBias, 0.5)[10];
  for (std::size_t i = 0; i < whole.imu.size(); ++i) {
    EXPECT_EQ(turned.imu[i].angular_rate_B - whole.imu[i].angular_rate_B,
              Eigen::Vector3d(Rad(2), 0, 0));
    EXPECT_EQ(turned.imu[i].specific_force_B, whole.imu[i].specific_force_B);
    EXPECT_EQ(pushed.imu[i].specific_force_B - whole.imu[i].specific_force_B,
              Eigen::Vector3d(0.5, 0, 0));
    EXPECT_EQ(pushed.imu[i].angular_rate_B, whole.imu[i].angular_rate_B);
  }
  EXPECT_EQ(pushed.poses[2].X_WB.R, whole.poses[2].X_WB.R);
}

TEST(VehicleFaults, ALaserWithoutReturnAnswersWithNone) {
  const FrameBundle bundle = Struck(FaultKind::kLaserNoReturn)[10];
  ASSERT_EQ(bundle.laser.size(), 2u);
  EXPECT_TRUE(std::isnan(bundle.laser[1].range_m));
  EXPECT_EQ(bundle.laser[1].time, BundleOfEverything(10).laser[1].time);
}

// A Gauss-Markov error: its sigma, its correlation exp(-t/5 s), and half of the fixes.
TEST(VehicleFaults, InACanyonFixesWanderAndHalfAreLost) {
  VehicleFaults faults(3);
  constexpr int kFixes = 60000;
  constexpr double kSigma_m = 4, kTime_s = 5, kStep_s = 0.1;
  std::vector<std::optional<double>> error(kFixes);
  int received = 0;
  for (int i = 0; i < kFixes; ++i) {
    FrameBundle bundle = BundleOfEverything(i);
    const Eigen::Vector3d truth = bundle.gps[0].p_WB;
    faults.Apply(bundle, {{.kind = FaultKind::kGpsCanyon, .value = kSigma_m}}, 0.1 * i);
    if (!bundle.gps.empty()) {
      error[static_cast<std::size_t>(i)] = (bundle.gps[0].p_WB - truth).y();
      ++received;
    }
  }
  EXPECT_NEAR(received, 0.5 * kFixes, 4 * std::sqrt(0.25 * kFixes));
  const auto mean_product = [&](std::size_t lag) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = lag; i < error.size(); ++i) {
      if (error[i] && error[i - lag]) {
        sum += *error[i] * *error[i - lag];
        ++count;
      }
    }
    return sum / count;
  };
  // 6,000 s of it are 600 independent stretches of twice its time: 6 % of the variance, twice.
  for (const std::size_t lag : {0u, 10u, 50u}) {
    const double expected =
        kSigma_m * kSigma_m * std::exp(-static_cast<double>(lag) * kStep_s / kTime_s);
    EXPECT_NEAR(mean_product(lag), expected, 0.12 * kSigma_m * kSigma_m) << lag;
  }
}

TEST(VehicleFaults, ClockMovesEveryStampOfTheVehicle) {
  for (const double step_s : {5.0, -5.0, 86400.0}) {
    const FrameBundle moved = Struck(FaultKind::kClockStep, step_s)[10];
    const FrameBundle whole = BundleOfEverything(10);
    const std::int64_t off_us = std::llround(1e6 * step_s);
    EXPECT_EQ(moved.time.us - whole.time.us, off_us);
    EXPECT_EQ(moved.stereo->time.us - whole.stereo->time.us, off_us);
    EXPECT_EQ(moved.poses[2].time.us - whole.poses[2].time.us, off_us);
    EXPECT_EQ(moved.imu[2].time.us - whole.imu[2].time.us, off_us);
    EXPECT_EQ(moved.laser[0].time.us - whole.laser[0].time.us, off_us);
    EXPECT_EQ(moved.gps[0].time.us - whole.gps[0].time.us, off_us);
    EXPECT_EQ(moved.status->time.us - whole.status->time.us, off_us);
    EXPECT_EQ(moved.truth[0].time.us - whole.truth[0].time.us, off_us);
  }
  const FrameBundle drifted = Struck(FaultKind::kClockDrift, 0.01)[15];
  EXPECT_NEAR(SecondsBetween(BundleOfEverything(15).time, drifted.time), 0.01 * (1.5 - kFrom_s),
              1e-6);
}

TEST(VehicleFaults, ARestartHasAnotherBootAndAClockThatBeginsAgain) {
  const FrameBundle boot = Struck(FaultKind::kNewBoot)[10];
  EXPECT_NE(boot.status->boot_id, 77u);
  EXPECT_EQ(boot.time, BundleOfEverything(10).time);
  const FrameBundle restart = Struck(FaultKind::kRestart)[5];
  EXPECT_EQ(restart.status->boot_id, boot.status->boot_id);
  EXPECT_EQ(restart.status->mode, VehicleMode::kHover);
  EXPECT_EQ(restart.status->approval_id, 0u);
  EXPECT_EQ(restart.time, kFlightStart);
}

TEST(VehicleFaults, AnEstimateGoesToTheVehicleOnItsClock) {
  PositionEstimate estimate;
  estimate.time = {100};
  EXPECT_EQ(std::get<PositionEstimate>(OnClock(estimate, 7)).time.us, 107);
}

}  // namespace
}  // namespace palace
