// What vision positions share, what is turned back, and what a filter makes of rough fixes.
#include "engine/navigation/shared_errors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/navigation/position_filter.h"
#include "engine/navigation/vision_fix.h"
#include "tests/navigation/flight.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Timestamp At(double t) { return AddSeconds({}, t); }

Matrix3d Turn(const Vector3d& v) {
  return Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
}

TEST(SharedErrors, CovarianceIsThatOfDrawnErrors) {
  const SharedErrors shared{.p_WS = {3, -2, 1},
                            .placed_from_W = {-13, -2, -14},
                            .bias_rad = Rad(0.3),
                            .placed_rad = Rad(0.1),
                            .place_m = Vector3d(0.02, 0.03, 0.01),
                            .height_m = 0.05};
  const Vector3d p_WB(-10, 1, -9);
  const Vector3d u = (shared.p_WS - p_WB).normalized();
  RandomStream random(1);
  Matrix3d drawn = Matrix3d::Zero();
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const Vector3d e = NormalVector(random, shared.bias_rad).cross(p_WB - shared.p_WS) +
                       NormalVector(random, shared.placed_rad).cross(p_WB - shared.placed_from_W) +
                       NormalVector(random, 1).cwiseProduct(shared.place_m) +
                       shared.height_m * random.Normal() / u.z() * u;
    drawn += e * e.transpose() / kCount;
  }
  const Matrix3d told = shared.CovarianceAt(p_WB);
  EXPECT_LT((drawn - told).norm(), 0.03 * told.norm());
}

TEST(SharedErrors, AttitudeCostsNothingAtTheSite) {
  const SharedErrors shared{.p_WS = {3, -2, 1}, .bias_rad = Rad(1)};
  EXPECT_LT(shared.CovarianceAt(shared.p_WS).norm(), 1e-12);
  EXPECT_EQ(SharedErrors{}.CovarianceAt({5, 5, -5}), Matrix3d(Matrix3d::Zero()));
}

// The ground was laid with an attitude that was off by w: every position by it is turned about
// where it was laid from, and its ground stands at the site's height all the same.
TEST(LandmarkFrame, TurnsBackTheAttitudeThatPlacedTheLandmarks) {
  const Vector3d p_WS(0, 0, 0), w(Rad(0.2), Rad(-0.3), Rad(0.1));
  const Matrix3d R_true = RotationFromEuler({0.02, -0.03, 0.4});
  const Vector3d from_W(-15, 1, -15);
  const Matrix3d wrong = Turn(w);
  LandmarkFrame frame;
  const RigidTransform untouched{R_true, from_W};
  EXPECT_EQ(frame.Levelled(untouched, p_WS).p, from_W);
  RandomStream random(2);
  double error_m = 0;
  for (int i = 0; i < 100; ++i) {
    const Vector3d p_true = from_W + Vector3d(0.1, 0, 0.1) * i;
    const RigidTransform resected{wrong * R_true, from_W + wrong * (p_true - from_W)};
    frame.Add(resected, Turn(i == 0 ? w : NormalVector(random, Rad(0.2))) * R_true);
    const RigidTransform levelled = frame.Levelled(resected, p_WS);
    // The tracker lays the ground at the site's height: the camera stands that much off.
    const double lift_m = (from_W + wrong.transpose() * (p_WS - from_W)).z();
    error_m = (levelled.p - p_true + Vector3d(0, 0, lift_m)).norm();
  }
  EXPECT_LT(error_m, 0.03);
  EXPECT_GT((wrong * Vector3d(9.9, 0, 9.9) - Vector3d(9.9, 0, 9.9)).norm(), 0.06);
}

struct Rough {
  int refused = 0, longest_in_row = 0;
  double nis_per_dof = 0;  ///< of the second half
};

/// Fixes at 10 Hz of a vehicle that stands, `times` as rough as they state, off by `step_m` from
/// the 60th of 120 on.
Rough Stand(double times, double step_m, bool measures) {
  PositionFilter filter(measures);
  FilterSeed seed;
  seed.time = At(0);
  seed.p_covariance_m2 = 1e-4 * Matrix3d::Identity();
  filter.Start(seed, {});
  RandomStream random(3);
  Rough rough;
  int judged = 0;
  for (int i = 1; i <= 1200; ++i) {
    const double t = 0.01 * i;
    filter.AddImu(At(t), {0, 0, -kStandardGravity_mps2}, Matrix3d::Identity());
    if (i % 10 != 0) {
      continue;
    }
    PositionMeasurement fix;
    fix.time = At(t);
    fix.p_WB = NormalVector(random, 0.005 * times) + Vector3d(i >= 600 ? step_m : 0, 0, 0);
    fix.p_covariance_m2 = 2.5e-5 * Matrix3d::Identity();
    rough.refused += filter.AddFix(fix) == FixOutcome::kRejected ? 1 : 0;
    rough.longest_in_row = std::max(rough.longest_in_row, filter.rejected_in_row());
    if (i >= 600) {
      rough.nis_per_dof += filter.nis() / 3;
      ++judged;
    }
  }
  rough.nis_per_dof /= judged;
  return rough;
}

TEST(PositionFilter, MeasuredScatterMakesRoughFixesHonest) {
  const Rough as_stated = Stand(1, 0, true);
  EXPECT_LE(as_stated.refused, 3);
  EXPECT_NEAR(as_stated.nis_per_dof, 0.9, 0.3);
  const Rough rough = Stand(4, 0, true), believed = Stand(4, 0, false);
  EXPECT_NEAR(rough.nis_per_dof, 1, 0.4);
  EXPECT_LT(rough.refused, 12);
  EXPECT_GT(believed.nis_per_dof, 3) << "what it was without";
}

TEST(PositionFilter, ASmallStepIsTakenAndAWrongPlaceIsRefused) {
  EXPECT_LT(Stand(1, 0.05, true).longest_in_row, 5);
  EXPECT_GE(Stand(1, 0.05, false).longest_in_row, 5);
  EXPECT_EQ(Stand(1, 3, true).longest_in_row, 61);
}

}  // namespace
}  // namespace palace
