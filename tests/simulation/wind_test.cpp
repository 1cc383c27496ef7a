// Dryden gusts against the standard deviations they are stated to have.
#include "engine/simulation/wind.h"

#include <cmath>
#include <vector>

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

// Covariance over time: r(tau) = s^2 e^(-tau/T) along the wind and s^2 e^(-tau/T) (1 - tau / 2T)
// for the filters with a double pole; none between the axes.
TEST(Wind, GustsHaveTheStatedCovariance) {
  constexpr double kHeight_m = 15.24, kAirspeed_mps = 12, kStep_s = 0.05;
  constexpr int kSteps = 480'000, kLag = 20;  // 24,000 s; correlations each second
  WindOptions options;
  options.gust_w20_mps = 7.72;
  WindModel wind(options, 12);
  std::vector<Eigen::Vector3d> gusts;
  gusts.reserve(kSteps / kLag);
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector3d air = wind.Advance(kStep_s, kHeight_m, kAirspeed_mps);
    if (i % kLag == 0) {
      gusts.push_back(air);
    }
  }
  const Eigen::Vector3d sigma = DrydenSigma(options.gust_w20_mps, kHeight_m);
  const double h_ft = 50, along_s = h_ft / std::pow(0.177 + 0.000823 * h_ft, 1.2) * 0.3048 / 12;
  const double down_s = h_ft * 0.3048 / 12;
  for (int lag = 0; lag <= 16; lag += 4) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    const std::size_t pairs = gusts.size() - static_cast<std::size_t>(lag);
    for (std::size_t i = 0; i < pairs; ++i) {
      sum += gusts[i] * gusts[i + static_cast<std::size_t>(lag)].transpose();
    }
    // In shares of the deviations. The wind blows to the south, so both horizontal axes are turned.
    const Eigen::Matrix3d covariance = sigma.cwiseInverse().asDiagonal() *
                                       (sum / static_cast<double>(pairs)) *
                                       sigma.cwiseInverse().asDiagonal();
    const double tau_s = lag * kLag * kStep_s;
    const auto doubled = [&](double T) { return std::exp(-tau_s / T) * (1 - tau_s / (2 * T)); };
    const Eigen::Vector3d theory(std::exp(-tau_s / along_s), doubled(along_s), doubled(down_s));
    // 24,000 s hold 1,500 times the longest time constant: 2.6 % of sampling error, three times
    // that.
    EXPECT_LT((covariance - Eigen::Matrix3d(theory.asDiagonal())).cwiseAbs().maxCoeff(), 0.08)
        << "seed 12, after " << tau_s << " s\n"
        << covariance << "\ntheory " << theory.transpose();
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
