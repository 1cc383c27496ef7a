// What vision positions share, and what a filter makes of rough fixes.
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

TurnCovariance Turns(const Vector3d& placed_rad, const Vector3d& bias_rad) {
  Eigen::Matrix<double, 6, 1> sigma_rad;
  sigma_rad << placed_rad, bias_rad;
  return TurnCovariance(sigma_rad.cwiseAbs2().asDiagonal());
}

TEST(SharedErrors, CovarianceIsThatOfDrawnErrors) {
  const Vector3d bias_rad(Rad(0.3), Rad(0.2), Rad(0.4)), placed_rad(Rad(0.1), Rad(0.15), Rad(0.2));
  const SharedErrors shared{.p_WS = {3, -2, 1},
                            .placed_from_W = {-13, -2, -14},
                            .turns_rad2 = Turns(placed_rad, bias_rad),
                            .place_m = Vector3d(0.02, 0.03, 0.01),
                            .height_m = 0.05};
  const Vector3d p_WB(-10, 1, -9);
  const Vector3d u = (shared.p_WS - p_WB).normalized();
  RandomStream random(1);
  Matrix3d drawn = Matrix3d::Zero();
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const Vector3d w = NormalVector(random, 1).cwiseProduct(placed_rad);
    Vector3d placed = w.cross(p_WB - shared.placed_from_W);
    placed.z() -= w.cross(shared.p_WS - shared.placed_from_W).z();
    const Vector3d e = NormalVector(random, 1).cwiseProduct(bias_rad).cross(p_WB - shared.p_WS) +
                       placed + NormalVector(random, 1).cwiseProduct(shared.place_m) +
                       shared.height_m * random.Normal() / u.z() * u;
    drawn += e * e.transpose() / kCount;
  }
  const Matrix3d told = shared.CovarianceAt(p_WB);
  EXPECT_LT((drawn - told).norm(), 0.03 * told.norm());
}

TEST(SharedErrors, AttitudeCostsNothingAtTheSite) {
  const SharedErrors shared{.p_WS = {3, -2, 1},
                            .turns_rad2 = Turns({0, 0, 0}, Vector3d::Constant(Rad(1)))};
  EXPECT_LT(shared.CovarianceAt(shared.p_WS).norm(), 1e-12);
  EXPECT_EQ(SharedErrors{}.CovarianceAt({5, 5, -5}), Matrix3d(Matrix3d::Zero()));
}

// Near the ground heights are known by the ground itself, however it was turned.
TEST(SharedErrors, TurnedGroundIsAtTheSitesHeight) {
  const SharedErrors shared{.placed_from_W = {-15, 0, -15},
                            .turns_rad2 = Turns(Vector3d::Constant(Rad(0.3)), {0, 0, 0})};
  EXPECT_LT(shared.CovarianceAt({0, 0, -1})(2, 2), 1e-4 * 1e-4);
  EXPECT_GT(std::sqrt(shared.CovarianceAt({0, 0, -1})(0, 0)), Rad(0.3) * 13);
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

// One fix that is refused may be anywhere: it says nothing of the others.
TEST(PositionFilter, OneWrongFixOpensTheGateALittleAndARowOfThemOpensIt) {
  PositionFilter filter(/*measures_scatter=*/true);
  FilterSeed seed;
  seed.p_covariance_m2 = 1e-4 * Matrix3d::Identity();
  filter.Start(seed, {});
  PositionMeasurement fix;
  fix.p_covariance_m2 = 1e-4 * Matrix3d::Identity();
  fix.p_WB = {40, 0, 0};
  double factor = 1;
  for (int i = 1; i <= 30; ++i) {
    fix.time = At(0.1 * i);
    ASSERT_EQ(filter.AddFix(fix), FixOutcome::kRejected) << i;
    EXPECT_GT(filter.variance_factor(), std::min(1.15 * factor, 99.0)) << i;
    EXPECT_LT(filter.variance_factor(), (1 + 0.24 * i) * factor) << i;
    EXPECT_LE(filter.variance_factor(), 100) << i;
    factor = filter.variance_factor();
  }
  filter.Stop();
  EXPECT_FALSE(filter.running());
  filter.Start(seed, {});
  EXPECT_EQ(filter.variance_factor(), factor) << "scatter is of the fixes, not of the state";
  filter.Reset();
  EXPECT_EQ(filter.variance_factor(), 1);
}

// A filter that begins by believing one rough fix runs off with its velocity. Begun anew it knows
// how rough they are.
TEST(PositionFilter, FixesFarRougherThanStatedDoNotLockItOut) {
  PositionFilter filter(/*measures_scatter=*/true);
  RandomStream random(3);
  int restarts = -1, refused_late = 0;
  for (int i = 1; i <= 120; ++i) {
    PositionMeasurement fix;
    fix.time = At(0.1 * i);
    fix.p_WB = NormalVector(random, 0.04);
    fix.p_covariance_m2 = 2.5e-5 * Matrix3d::Identity();
    if (filter.running() && filter.rejected_in_row() >= 5) {
      filter.Stop();
    }
    if (!filter.running()) {
      FilterSeed seed;
      seed.time = fix.time;
      seed.p_WB = fix.p_WB;
      seed.p_covariance_m2 = filter.variance_factor() * fix.p_covariance_m2;
      filter.Start(seed, {});
      ++restarts;
      continue;
    }
    for (int k = 9; k >= 0; --k) {
      filter.AddImu(At(0.1 * i - 0.01 * k), {0, 0, -kStandardGravity_mps2}, Matrix3d::Identity());
    }
    const bool refused = filter.AddFix(fix) == FixOutcome::kRejected;
    refused_late += refused && i > 60 ? 1 : 0;
  }
  EXPECT_LE(restarts, 2);
  EXPECT_LE(refused_late, 3);
}

TEST(PositionFilter, ASmallStepIsTakenAndAWrongPlaceIsRefused) {
  EXPECT_LT(Stand(1, 0.05, true).longest_in_row, 5);
  EXPECT_GE(Stand(1, 0.05, false).longest_in_row, 5);
  EXPECT_EQ(Stand(1, 3, true).longest_in_row, 61);
}

}  // namespace
}  // namespace palace
