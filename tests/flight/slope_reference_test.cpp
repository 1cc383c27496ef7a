#include "engine/flight/slope_reference.h"

#include <cmath>

#include <gtest/gtest.h>

namespace palace {
namespace {

using Eigen::Vector3d;
constexpr double kStep_s = 0.02;

FlightPath Slope() {
  ApproachPlan plan;
  plan.heading_rad = 0;
  plan.glide_slope_rad = Rad(45);
  plan.descent_rate_mps = 1;
  return PathOf(plan, {20, 0, 0}, {{0.6, -0.5, 0.2}, {0, 0, 1}, 0});
}

TEST(SlopeReference, ComesDownThePathFromWhereItIsWithoutAStep) {
  const FlightPath path = Slope();
  const Vector3d aside(0.3, -0.2, 0);
  MovingReference reference;
  reference.p_W = path.BodyAt(15) + aside;
  SlopeReference slope = SlopeReference::From(path, reference.p_W);
  EXPECT_NEAR(slope.height_m, 15, 1e-12);
  double t = 0;
  while (slope.height_m > path.speeds.slope_end_m) {
    const MovingReference before = reference;
    slope.Step(path, true, kStep_s, reference);
    t += kStep_s;
    ASSERT_LT(t, 60);
    EXPECT_LT((reference.v_W - before.v_W).norm(), 0.02);
    EXPECT_LT((reference.p_W - before.p_W).norm(), 0.04);
    const Vector3d beside = reference.p_W - path.BodyAt(slope.height_m);
    EXPECT_LT((beside - std::exp(-t / 3) * aside).norm(), 1e-9) << t;
  }
  EXPECT_NEAR(slope.rate_mps, 0.1, 0.05);  // braked before the end
}

TEST(SlopeReference, StopsFourTimesAsHardAsItStarts) {
  const FlightPath path = Slope();
  MovingReference reference;
  reference.p_W = path.BodyAt(15);
  SlopeReference slope = SlopeReference::From(path, reference.p_W);
  const auto steps_until = [&](bool moves, double rate_mps) {
    int steps = 0;
    while (steps < 1000 && std::abs(slope.rate_mps - rate_mps) > 1e-9) {
      slope.Step(path, moves, kStep_s, reference);
      ++steps;
    }
    return steps;
  };
  EXPECT_NEAR(steps_until(true, 1), 1 / (0.3 * kStep_s), 1);
  EXPECT_NEAR(steps_until(false, 0), 1 / (1.2 * kStep_s), 1);
  const double stopped_m = slope.height_m;
  slope.Step(path, false, kStep_s, reference);
  EXPECT_EQ(slope.height_m, stopped_m);
  EXPECT_EQ(reference.v_W, Vector3d::Zero());
}

}  // namespace
}  // namespace palace
