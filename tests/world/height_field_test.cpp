// Relief of the ground: heights, normals and rays agree with a search by small steps.
#include "engine/world/height_field.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/world/lattice_noise.h"
#include "engine/world/world.h"

namespace palace {
namespace {

using Eigen::Vector3d;

HeightField Rough(std::uint64_t seed) {
  return HeightField({-10, -8, 16, 7}, [seed](double n, double e) {
    const double hole = std::hypot(n - 1, e + 2) < 0.6 ? -0.5 : 0.0;
    return 0.3 * FractalNoise(n, e, seed, 4, 0.4, 0.8) + hole;
  });
}

/// Where the ray is first under the surface, by steps of a millimetre.
double BySteps(const HeightField& field, const Vector3d& p, const Vector3d& r) {
  for (double s = 0; s < 80; s += 1e-3) {
    const Vector3d at = p + s * r;
    if (-at.z() < field.Height(at.x(), at.y())) {
      return s;
    }
  }
  return std::numeric_limits<double>::infinity();
}

TEST(HeightField, RaysMeetItWhereAStepwiseSearchDoes) {
  const HeightField field = Rough(5);
  RandomStream random(21);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Vector3d p(random.Uniform(-20, 20), random.Uniform(-20, 20), -random.Uniform(2, 12));
    Vector3d r(random.Normal(), random.Normal(), random.Uniform(0.2, 2));
    r.normalize();
    const double s = field.Cast(p, r), expected = BySteps(field, p, r);
    ASSERT_NEAR(s, expected, 2e-3);
    const Vector3d at = p + s * r;
    EXPECT_NEAR(-at.z(), field.Height(at.x(), at.y()), 1e-9);
  }
}

TEST(HeightField, RaysAlongAxesAndStraightDownMeetIt) {
  const HeightField field = Rough(6);
  for (const Vector3d& r : {Vector3d(0, 0, 1), Vector3d(1, 0, 1), Vector3d(0, -1, 1),
                            Vector3d(1, 1, 1), Vector3d(-1, 1, 0.3)}) {
    const Vector3d p(0.125, -0.25, -5);  // on a corner of the grid
    const double s = field.Cast(p, r);
    const Vector3d at = p + s * r;
    EXPECT_NEAR(-at.z(), field.Height(at.x(), at.y()), 1e-9);
  }
}

TEST(HeightField, WhatGoesUpOrStartsBelowMeetsNothing) {
  const HeightField field = Rough(7);
  EXPECT_TRUE(std::isinf(field.Cast({0, 0, -5}, {0.5, 0.2, -1})));
  EXPECT_TRUE(std::isinf(field.Cast({0, 0, 5}, {0.1, 0, 1})));
}

TEST(HeightField, GoesOnMirroredWithoutAStep) {
  const HeightField field = Rough(8);
  for (const double e : {-7.3, 0.0, 6.1}) {
    EXPECT_NEAR(field.Height(6 - 0.3, e), field.Height(6 + 0.3, e), 0.05);
    EXPECT_DOUBLE_EQ(field.Height(6 - 1e-9, e), field.Height(6 - 1e-9, e));
    EXPECT_NEAR(field.Height(6 - 1e-6, e), field.Height(6 + 1e-6, e), 1e-5);
    EXPECT_NEAR(field.Height(-10 - 1e-6, e), field.Height(-10 + 1e-6, e), 1e-5);
  }
}

TEST(HeightField, NormalIsSquareToTheSurface) {
  const HeightField field = Rough(9);
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) {
    const double n = random.Uniform(-9, 5), e = random.Uniform(-7, 7), d = 1e-5;
    const Vector3d normal = field.Normal(n, e);
    EXPECT_LT(normal.z(), 0);
    const Vector3d along(d, 0, -(field.Height(n + d, e) - field.Height(n, e)));
    EXPECT_NEAR(normal.dot(along) / d, 0, 1e-6);
  }
}

TEST(Ground, ReliefLiesOnThePlane) {
  Ground ground;
  ground.rise_north = 0.1;
  ground.rise_east = -0.05;
  ground.relief = std::make_shared<const HeightField>(Rough(4));
  const Vector3d p(3, -2, -9), r(0.3, 0.5, 1);
  const Hit hit = CastGround(ground, p, r);
  const Vector3d at = p + hit.s * r;
  EXPECT_NEAR(-at.z(), ground.Height(at.x(), at.y()), 1e-9);
  const double d = 1e-5;
  const Vector3d along(0, d, -(ground.Height(2.03, 1.01 + d) - ground.Height(2.03, 1.01)));
  EXPECT_NEAR(ground.NormalAt(2.03, 1.01).dot(along) / d, 0, 1e-6);
}

}  // namespace
}  // namespace palace
