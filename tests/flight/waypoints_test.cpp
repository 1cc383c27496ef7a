// The travelling reference: limits kept on the way, arrival at rest.
#include "engine/flight/waypoints.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

TEST(MovingReference, KeepsItsLimitsAndArrivesAtRest) {
  RandomStream random(9);
  const TravelLimits limits{2.0, 0.4};
  const double dt = 0.02;
  for (int trial = 0; trial < 200; ++trial) {
    MovingReference reference;
    reference.v_W = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
    const Eigen::Vector3d goal(random.Uniform(-20, 20), random.Uniform(-20, 20),
                               random.Uniform(-5, 5));
    for (int i = 0; i < 60 * 50; ++i) {
      const Eigen::Vector3d before = reference.v_W, p_before = reference.p_W;
      reference.MoveTowards(goal, limits, dt);
      ASSERT_LE(reference.v_W.norm(), limits.max_speed_mps + 1e-9) << "trial " << trial;
      ASSERT_LE((reference.v_W - before).norm(), 3 * limits.acceleration_mps2 * dt + 1e-9);
      ASSERT_LE((reference.p_W - p_before).norm(), limits.max_speed_mps * dt + 1e-9);
    }
    EXPECT_LT((reference.p_W - goal).norm(), 0.01) << "trial " << trial;
    EXPECT_LT(reference.v_W.norm(), 0.05) << "trial " << trial;
  }
}

TEST(TravelTime, IsWhatTheReferenceTakes) {
  RandomStream random(10);
  for (int trial = 0; trial < 100; ++trial) {
    const TravelLimits limits{random.Uniform(0.5, 3), random.Uniform(0.2, 1)};
    const double distance_m = random.Uniform(0.5, 30), dt = 0.02;
    MovingReference reference;
    const Eigen::Vector3d goal(distance_m, 0, 0);
    double taken_s = 0;
    for (; (reference.p_W - goal).norm() > 0.02; taken_s += dt) {
      reference.MoveTowards(goal, limits, dt);
    }
    EXPECT_NEAR(TravelTime(distance_m, limits), taken_s, 0.06 * taken_s + 0.4)
        << "seed 10 trial " << trial;
  }
  EXPECT_EQ(TravelTime(0, {}), 0);
}

TEST(SlewAngle, TakesTheShortWay) {
  EXPECT_NEAR(SlewAngle(3.1, -3.1, 0.05), -2 * 3.14159265358979 + 3.15, 1e-9);
  EXPECT_NEAR(SlewAngle(0.5, 0.52, 0.05), 0.52, 1e-12);
}

}  // namespace
}  // namespace palace
