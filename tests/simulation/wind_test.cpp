// Dryden gusts against the standard deviations they are stated to have.
#include "engine/simulation/wind.h"

#include <cmath>

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(Wind, GustsHaveTheStatedDeviation) {
  WindOptions options;
  options.gust_w20_mps = 7.72;  // 15 kt, light
  const double height_m = 15.24;
  const Eigen::Vector3d sigma = DrydenSigma(options.gust_w20_mps, height_m);
  // MIL-F-8785C at 50 ft: s_w = 0.1 W20, s_u = s_w / (0.177 + 0.04115)^0.4.
  EXPECT_NEAR(sigma.z(), 0.772, 1e-12);
  EXPECT_NEAR(sigma.x(), 0.772 / std::pow(0.21815, 0.4), 1e-6);

  // 4000 s hold only a few hundred independent gusts; twelve times that beat the sampling error
  // down.
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  const int steps = 40 * 4000;
  WindModel wind(options, 11);
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < 5; ++k) {
      wind.Advance(0.05, height_m, 12);
    }
    const Eigen::Vector3d air = wind.Advance(0.05, height_m, 12);
    // Wind from north: along it is north, across it east, so the axes need no turning.
    squares += air.cwiseAbs2();
  }
  const Eigen::Vector3d measured = (squares / steps).cwiseSqrt();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(measured[axis] / sigma[axis], 1, 0.05) << "axis " << axis;
  }
}

TEST(Wind, MeanFollowsTheLogarithmicProfile) {
  WindOptions options;
  options.mean_mps = 5;
  options.from_rad = std::numbers::pi / 2;  // from the east: blows to the west
  const WindModel wind(options, 1);
  EXPECT_TRUE(wind.Mean(20 * 0.3048).isApprox(Eigen::Vector3d(0, -5, 0), 1e-12));
  EXPECT_NEAR(wind.Mean(15.24).norm(), 5 * std::log(50 / 0.15) / std::log(20 / 0.15), 1e-12);
}

TEST(Wind, CalmByDefault) {
  WindModel wind({}, 1);
  EXPECT_EQ(wind.Advance(0.005, 15, 1), Eigen::Vector3d(0, 0, 0));
}

}  // namespace
}  // namespace palace
