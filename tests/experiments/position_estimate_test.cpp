// The approach that position estimates are judged on, and the figures they are judged by.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/experiments/cone_approach.h"
#include "engine/experiments/position_rows.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

TEST(ConeApproach, KeepsTheConeInTheMiddleDownTheSlope) {
  const VehicleDescription& vehicle = DefaultVehicle();
  ConeApproach approach({.seed = 3, .render = false}, nullptr);
  double first_m = NAN, last_m = NAN;
  while (true) {
    const auto next = approach.Next();
    ASSERT_TRUE(next) << next.error().message;
    if (!*next) {
      break;
    }
    const RigidTransform X_WC = (*next)->X_WB * vehicle.rig.X_BC();
    const PinholeCamera& camera = vehicle.rig.left.pinhole;
    const auto pixel = PixelFromWorldPoint(camera, X_WC, approach.p_W_cone());
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - Eigen::Vector2d(camera.cx_px, camera.cy_px)).norm(), 100);
    const Eigen::Vector3d skid_W = (*next)->X_WB * vehicle.lander.skid_centre_B();
    last_m = approach.p_W_cone().z() - skid_W.z();
    first_m = std::isnan(first_m) ? (*next)->X_WB.p.z() : first_m;
  }
  EXPECT_NEAR(first_m, -15.24, 0.2);
  EXPECT_NEAR(last_m, 2.0, 0.3);
}

TEST(AttitudeOf, ReplacesAttitudesAndNothingElse) {
  ConeApproach approach({.seed = 4, .render = false}, nullptr);
  AttitudeOf perfect(AttitudeQuality::kPerfect, 1), poor(AttitudeQuality::kPoor, 1);
  double worst_rad = 0;
  for (int i = 0; i < 20; ++i) {
    const auto next = approach.Next();
    ASSERT_TRUE(next && *next);
    const auto exact = perfect.Told((*next)->bundle, approach);
    const auto wrong = poor.Told((*next)->bundle, approach);
    ASSERT_EQ(exact->poses.size(), (*next)->bundle->poses.size());
    for (std::size_t k = 0; k < exact->poses.size(); ++k) {
      const RigidTransform truth = approach.TruePoseAt(exact->poses[k].time);
      EXPECT_LT((exact->poses[k].X_WB.R - truth.R).norm(), 1e-12);
      EXPECT_EQ(exact->poses[k].X_WB.p, (*next)->bundle->poses[k].X_WB.p);
      const Eigen::AngleAxisd off(Eigen::Matrix3d(truth.R.transpose() * wrong->poses[k].X_WB.R));
      worst_rad = std::max(worst_rad, off.angle());
    }
    EXPECT_EQ(wrong->pose_at_exposure->X_WB.R, wrong->poses.back().X_WB.R);
  }
  EXPECT_GT(worst_rad, Rad(0.3));
  EXPECT_LT(worst_rad, Rad(3));
}

TEST(PositionError, IsOnePerDegreeOfFreedomWhereTheCovarianceIsTrue) {
  RandomStream random(5);
  const Eigen::Vector3d sigma_m(0.01, 0.05, 0.2);
  const Eigen::Matrix3d R = RotationFromEuler({0.3, 0.4, 0.5});
  const Eigen::Matrix3d covariance_m2 = R * sigma_m.cwiseAbs2().asDiagonal() * R.transpose();
  double nees = 0;
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d n(random.Normal(), random.Normal(), random.Normal());
    const PositionError error{R * n.cwiseProduct(sigma_m), covariance_m2};
    nees += error.NeesPerDof() / kCount;
    axes += error.NeesOfAxes() / kCount;
  }
  EXPECT_NEAR(nees, 1, 0.05);
  EXPECT_LT((axes - Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff(), 0.1);
}

/// A flight of every case whose errors are `ratio` of the stated sigma, which is `sigma_m`.
TrialTable TableOf(double sigma_m, double ratio) {
  std::vector<PositionSample> samples(20);
  RandomStream random(6);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time = AddSeconds({}, 0.1 * static_cast<double>(i));
    const double sign = i % 2 == 0 ? 1 : -1;
    const PositionError error{Eigen::Vector3d::Constant(sign * ratio * sigma_m),
                              sigma_m * sigma_m * Eigen::Matrix3d::Identity()};
    samples[i].raw = samples[i].filtered = error;
  }
  TrialTable table;
  table.columns = PositionColumns();
  table.columns.insert(table.columns.begin(), {"trial", "seed"});
  std::vector<TrialRow> rows;
  for (const AttitudeQuality attitude : kAttitudeQualities) {
    for (const PositionEstimator estimator : kPositionEstimators) {
      AddPositionRows({480, NameOf(attitude), NameOf(estimator)}, samples, true, rows);
    }
  }
  for (TrialRow& row : rows) {
    row.insert(row.begin(), {"0", "1"});
    EXPECT_EQ(row.size(), table.columns.size());
    table.rows.push_back(row);
  }
  return table;
}

TEST(PositionReport, PassesWhatIsNearAndHonestAlone) {
  EXPECT_TRUE(PositionReport(TableOf(0.03, 1)).passed);
  EXPECT_FALSE(PositionReport(TableOf(0.1, 1)).passed) << "0.17 m off with a perfect attitude";
  EXPECT_FALSE(PositionReport(TableOf(0.03, 0.5)).passed) << "states twice its error";
  EXPECT_FALSE(PositionReport(TableOf(0.03, 1.5)).passed) << "states two thirds of its error";
}

}  // namespace
}  // namespace palace
