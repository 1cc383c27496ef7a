// The fitted form of the lens: equal to the CAHVOR model, right derivatives, dots as areas.
#include "engine/calibration/lens.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/camera/cahvor.h"
#include "engine/core/random.h"

namespace palace {
namespace {

constexpr std::uint64_t kSeed = 20261121;
constexpr int kTrials = 200;

Lens RandomLens(RandomStream& random) {
  Lens lens;
  lens << random.Uniform(400, 1200), random.Uniform(300, 340), random.Uniform(400, 1200),
      random.Uniform(220, 260), random.Uniform(-0.02, 0.02), random.Uniform(-0.02, 0.02),
      random.Uniform(-0.3, 0.1), random.Uniform(-0.05, 0.15);
  return lens;
}

Eigen::Vector3d RandomPoint(RandomStream& random) {
  const double z = random.Uniform(0.5, 20);
  return {z * random.Uniform(-0.5, 0.5), z * random.Uniform(-0.4, 0.4), z};
}

RigidTransform RandomPose(RandomStream& random) {
  const Eigen::Vector3d axis(random.Normal(), random.Normal(), 0.3 * random.Normal());
  RigidTransform X;
  X.R = Eigen::AngleAxisd(random.Uniform(0, 0.9), axis.normalized()).toRotationMatrix();
  X.p = RandomPoint(random);
  return X;
}

TEST(LensTest, EqualsTheCahvorModelItIsWrittenAs) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  RandomStream random(kSeed);
  for (int i = 0; i < kTrials; ++i) {
    const Lens lens = RandomLens(random);
    const RigidTransform X_FC = RandomPose(random);
    const CahvorModel model = CahvorFromLens(lens, X_FC, 640, 480);
    const Eigen::Vector3d p_C = RandomPoint(random);
    const auto by_lens = ProjectThroughLens(lens, p_C);
    const auto by_model = ProjectCahvor(model, X_FC * p_C);
    ASSERT_EQ(by_lens.has_value(), by_model.has_value()) << i;
    if (by_lens) {
      EXPECT_LT((by_lens->pixel - *by_model).norm(), 1e-8) << i;
    }
    RigidTransform X_back;
    const Lens back = LensFromCahvor(model, X_back);
    EXPECT_LT((back - lens).norm(), 1e-8) << i;
    EXPECT_LT((X_back.R - X_FC.R).norm(), 1e-12) << i;
  }
}

TEST(LensTest, DerivativesAgreeWithDifferences) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  RandomStream random(kSeed);
  for (int i = 0; i < kTrials; ++i) {
    const Lens lens = RandomLens(random);
    const Eigen::Vector3d p_C = RandomPoint(random);
    const auto at = ProjectThroughLens(lens, p_C);
    ASSERT_TRUE(at) << i;
    for (int k = 0; k < 3; ++k) {
      const double step = 1e-6 * p_C.z();
      const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(k);
      const Eigen::Vector2d slope =
          (ProjectThroughLens(lens, p_C + d)->pixel - ProjectThroughLens(lens, p_C - d)->pixel) /
          (2 * step);
      EXPECT_LT((slope - at->by_point.col(k)).norm(), 1e-5 * (1 + slope.norm())) << i << " p" << k;
    }
    for (int k = 0; k < kLensSize; ++k) {
      const double step = 1e-6 * std::max(1.0, std::abs(lens[k]));
      const Lens d = step * Lens::Unit(k);
      const Eigen::Vector2d slope =
          (ProjectThroughLens(lens + d, p_C)->pixel - ProjectThroughLens(lens - d, p_C)->pixel) /
          (2 * step);
      EXPECT_LT((slope - at->by_lens.col(k)).norm(), 1e-5 * (1 + slope.norm()))
          << i << " lens " << k;
    }
  }
}

TEST(LensTest, NothingBehindTheCameraOrBeyondTheFold) {
  Lens lens;
  lens << 700, 320, 700, 240, 0, 0, -0.5, 0;
  EXPECT_TRUE(ProjectThroughLens(lens, {0, 0, 1}));
  EXPECT_FALSE(ProjectThroughLens(lens, {0, 0, -1}));
  EXPECT_FALSE(ProjectThroughLens(lens, {0, 0, 0}));
  // r (1 - 0.5 r^2) turns back at r = sqrt(2 / 3).
  EXPECT_TRUE(ProjectThroughLens(lens, {0.81, 0, 1}));
  EXPECT_FALSE(ProjectThroughLens(lens, {0.82, 0, 1}));
}

/// Centroid of a dot's picture by brute force: small cells in polar coordinates, each weighed with
/// the area of its picture.
Eigen::Vector2d CentroidByIntegration(const Lens& lens, const RigidTransform& X_CT,
                                      const Eigen::Vector3d& p_T, double radius_m) {
  constexpr int kRings = 40, kSectors = 96;
  const auto project = [&](double x, double y) {
    return ProjectThroughLens(lens, X_CT * (p_T + Eigen::Vector3d(x, y, 0)))->pixel;
  };
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double area = 0;
  for (int i = 0; i < kRings; ++i) {
    const double r = radius_m * (i + 0.5) / kRings;
    for (int j = 0; j < kSectors; ++j) {
      const double angle = 2 * std::numbers::pi * j / kSectors;
      const double x = r * std::cos(angle), y = r * std::sin(angle), h = 1e-5;
      Eigen::Matrix2d by_plane;
      by_plane << (project(x + h, y) - project(x - h, y)) / (2 * h),
          (project(x, y + h) - project(x, y - h)) / (2 * h);
      const double weight = r * std::abs(by_plane.determinant());
      sum += weight * project(x, y);
      area += weight;
    }
  }
  return sum / area;
}

TEST(ProjectDotTest, AgreesWithTheIntegralOverTheDot) {
  RandomStream random(kSeed);
  double largest_shift = 0;
  for (int i = 0; i < 20; ++i) {
    Lens lens;
    lens << 770, 320, 770, 240, 0.006, -0.004, -0.19, 0.06;
    RigidTransform X_CT = RandomPose(random);
    X_CT.p = {random.Uniform(-0.8, 0.8), random.Uniform(-0.5, 0.5), 2.6};
    const double diameter_m = 0.06;  // 18 px
    const auto dot = ProjectDot(lens, X_CT, {0, 0, 0}, diameter_m);
    const auto centre = ProjectDot(lens, X_CT, {0, 0, 0}, 0);
    ASSERT_TRUE(dot && centre);
    const Eigen::Vector2d exact = CentroidByIntegration(lens, X_CT, {0, 0, 0}, diameter_m / 2);
    EXPECT_LT((dot->pixel - exact).norm(), 2e-4) << i;
    largest_shift = std::max(largest_shift, (exact - centre->pixel).norm());
  }
  EXPECT_GT(largest_shift, 0.02);  // the effect is there to be modelled
}

}  // namespace
}  // namespace palace
