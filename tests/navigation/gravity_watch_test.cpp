#include "engine/navigation/gravity_watch.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/navigation/navigator.h"
#include "tests/navigation/flight.h"

namespace palace {
namespace {

constexpr double kFrom_s = 8;

/// What is wrong from kFrom_s on.
struct Wrong {
  double roll_deg = 0, pitch_deg = 0, heading_deg = 0;
  Eigen::Vector3d accel_bias_mps2 = Eigen::Vector3d::Zero();
  double gps_velocity_sigma_mps = 0.05;
  double to_s = 1e9;
  double gps_to_s = 1e9;
  double no_attitude_from_s = 1e9, no_attitude_to_s = 1e9;
  bool has_velocity = true;
};

struct Told {
  double after_s = NAN;  ///< first said to be off, after kFrom_s; NaN never
  GravityAgreement end;
};

Told Fly(const Wrong& wrong, std::uint64_t seed, double seconds = 20) {
  RandomStream random(seed, "gravity");
  const Flight flight;
  Navigator navigator;
  Told told;
  for (int n = 1; n <= static_cast<int>(10 * seconds); ++n) {
    FrameBundle bundle;
    bundle.time = AddSeconds({1'000'000}, 0.1 * n);
    for (int k = 1; k <= 10; ++k) {
      const double t = 0.1 * (n - 1) + 0.01 * k;
      const bool acts = t >= kFrom_s && t < wrong.to_s;
      VehiclePose pose = flight.Pose(t);
      pose.time = AddSeconds({1'000'000}, t);
      ImuSample imu;
      imu.time = pose.time;
      imu.specific_force_B = flight.SpecificForce(t) + NormalVector(random, 0.05);
      if (acts) {
        pose.X_WB.R = RotationFromEuler({0, 0, Rad(wrong.heading_deg)}) * pose.X_WB.R *
                      RotationFromEuler({Rad(wrong.roll_deg), Rad(wrong.pitch_deg), 0});
        imu.specific_force_B += wrong.accel_bias_mps2;
      }
      bundle.imu.push_back(imu);
      if (t < wrong.no_attitude_from_s || t >= wrong.no_attitude_to_s) {
        bundle.poses.push_back(pose);
      }
    }
    if (n % 2 == 0 && 0.1 * n < wrong.gps_to_s) {
      GpsFix fix;  // 0.1 s late, as of a receiver
      const double t = 0.1 * n - 0.1;
      fix.time = AddSeconds({1'000'000}, t);
      fix.p_WB = flight.Position(t) + NormalVector(random, 0.02);
      fix.v_WB = wrong.has_velocity
                     ? Eigen::Vector3d(flight.Velocity(t) +
                                       NormalVector(random, wrong.gps_velocity_sigma_mps))
                     : Eigen::Vector3d::Constant(NAN);
      fix.sigma_horizontal_m = fix.sigma_vertical_m = 0.02;
      bundle.gps.push_back(fix);
    }
    navigator.AddSensors(bundle);
    told.end = navigator.status().gravity;
    if (told.end.off && std::isnan(told.after_s)) {
      told.after_s = 0.1 * n - kFrom_s;
    }
  }
  return told;
}

TEST(GravityWatch, NamesThreeDegreesWithinFourSecondsAndMeasuresThem) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const Wrong& wrong :
         {Wrong{.roll_deg = 3}, Wrong{.roll_deg = -3}, Wrong{.pitch_deg = 3},
          Wrong{.pitch_deg = 3, .gps_velocity_sigma_mps = 0.07},
          Wrong{.accel_bias_mps2 = {0.513, 0, 0}}, Wrong{.accel_bias_mps2 = {0, -0.513, 0}}}) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Told told = Fly(wrong, seed);
      EXPECT_GT(told.after_s, 0.5);
      EXPECT_LT(told.after_s, 4);
      EXPECT_NEAR(told.end.tilt_deg, 3, 0.4) << "of a fit over 5 s";
    }
  }
}

TEST(GravityWatch, NeverCriesWolf) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_TRUE(std::isnan(Fly({}, seed, 30).after_s));
    EXPECT_TRUE(std::isnan(Fly({.gps_velocity_sigma_mps = 0.3}, seed, 30).after_s));
    EXPECT_TRUE(std::isnan(Fly({.roll_deg = 0.7, .pitch_deg = 0.7}, seed, 30).after_s));
  }
}

TEST(GravityWatch, EndsWhenTheAttitudeComesBack) {
  const Told told = Fly({.roll_deg = 3, .to_s = 14}, 1, 22);
  EXPECT_LT(told.after_s, 4);
  EXPECT_FALSE(told.end.off);
  EXPECT_LT(told.end.tilt_deg, 0.4);
}

TEST(GravityWatch, WithoutVelocitiesNothingIsKnown) {
  const Told told = Fly({.roll_deg = 3, .has_velocity = false}, 1);
  EXPECT_TRUE(std::isnan(told.after_s));
  EXPECT_TRUE(std::isnan(told.end.tilt_deg));
}

TEST(GravityWatch, WhatWasOffStaysOffWithoutNewsAndThroughAGap) {
  EXPECT_TRUE(Fly({.roll_deg = 3, .gps_to_s = 14}, 1).end.off);
  // Three seconds after a gap of attitude the tilt is known again; until then it stands.
  const Wrong gap{.roll_deg = 3, .to_s = 14, .no_attitude_from_s = 14, .no_attitude_to_s = 16};
  EXPECT_TRUE(Fly(gap, 1, 18.5).end.off);
  EXPECT_TRUE(std::isnan(Fly(gap, 1, 18.5).end.tilt_deg));
  EXPECT_FALSE(Fly(gap, 1, 22).end.off);
}

// No acceleration, no lever: a heading that is wrong turns what is small.
TEST(GravityWatch, AWrongHeadingIsNotSeen) {
  EXPECT_TRUE(std::isnan(Fly({.heading_deg = 10}, 1, 30).after_s));
}

}  // namespace
}  // namespace palace
