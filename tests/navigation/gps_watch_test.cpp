#include "engine/navigation/gps_watch.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/navigation/navigator.h"
#include "tests/navigation/flight.h"

namespace palace {
namespace {

struct Receiver {
  double sigma_m = 0.02;
  double jump_m = 0, drift_mps = 0;
  double from_s = 5, to_s = 1e9;
  bool velocity_follows = false;
  bool has_velocity = true;
};

/// A fix of that receiver on `flight` at t.
GpsFix FixAt(const Receiver& receiver, const Flight& flight, double t, RandomStream& random) {
  GpsFix fix;
  fix.time = AddSeconds({1'000'000}, t);
  fix.p_WB = flight.Position(t) + NormalVector(random, receiver.sigma_m);
  fix.v_WB = flight.Velocity(t) + NormalVector(random, 0.03);
  fix.sigma_horizontal_m = fix.sigma_vertical_m = receiver.sigma_m;
  if (t >= receiver.from_s && t < receiver.to_s) {
    fix.p_WB.x() += receiver.jump_m + receiver.drift_mps * (t - receiver.from_s);
    fix.v_WB.x() += receiver.velocity_follows ? receiver.drift_mps : 0;
  }
  if (!receiver.has_velocity) {
    fix.v_WB.setConstant(NAN);
  }
  return fix;
}

/// Seconds from the fault to the watch's word; NaN never. The prediction is right to 3 cm.
double FoundAfter(const Receiver& receiver, std::uint64_t seed, double seconds = 12,
                  bool* off_at_end = nullptr) {
  RandomStream random(seed, "receiver");
  const Flight flight;
  GpsWatch watch;
  double found_s = NAN;
  for (int n = 0; n < static_cast<int>(5 * seconds); ++n) {
    const double t = 0.2 * n;
    FilterEstimate predicted;
    predicted.p_WB = flight.Position(t) + NormalVector(random, 0.03);
    predicted.sigma_p_m.setConstant(0.03);
    watch.Add(FixAt(receiver, flight, t, random), predicted);
    if (watch.status().off && std::isnan(found_s)) {
      found_s = t - receiver.from_s;
    }
  }
  if (off_at_end != nullptr) {
    *off_at_end = watch.status().off;
  }
  return found_s;
}

TEST(GpsWatch, FindsJumpsAndDriftsWithinASecond) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_LE(FoundAfter({.jump_m = 8}, seed), 0.5) << seed;
    EXPECT_LE(FoundAfter({.jump_m = -1.5}, seed), 0.5) << seed;
    EXPECT_LE(FoundAfter({.jump_m = 8, .has_velocity = false}, seed), 0.5) << seed;
    EXPECT_LE(FoundAfter({.sigma_m = 0.6, .jump_m = 4}, seed), 1.05) << "6.7 sigma " << seed;
    EXPECT_LE(FoundAfter({.drift_mps = 0.5}, seed), 1.05) << seed;
    EXPECT_LE(FoundAfter({.drift_mps = 2}, seed), 0.65) << seed;
    EXPECT_LE(FoundAfter({.drift_mps = 2, .velocity_follows = true}, seed), 1.05) << seed;
  }
}

TEST(GpsWatch, NeverCriesWolf) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    EXPECT_TRUE(std::isnan(FoundAfter({}, seed, 30))) << seed;
    EXPECT_TRUE(std::isnan(FoundAfter({.sigma_m = 1.5}, seed, 30))) << seed;
  }
}

TEST(GpsWatch, EndsWhenTheFixesComeBack) {
  bool off = true;
  FoundAfter({.jump_m = 8, .to_s = 7}, 1, 16, &off);
  EXPECT_FALSE(off);
  FoundAfter({.jump_m = 8}, 1, 16, &off);
  EXPECT_TRUE(off);
}

/// The filter's error at the end of a flight whose GPS goes wrong; the camera's site is tracked.
struct Flown {
  double error_m = 0;
  double worst_m = 0;
  int frame_moves = 0;
};
Flown FlyWith(const Receiver& receiver, bool site, double seconds) {
  RandomStream random(4, "flight");
  const Flight flight;
  Navigator navigator;
  Flown flown;
  for (int n = 1; n <= static_cast<int>(10 * seconds); ++n) {
    FrameBundle bundle;
    bundle.time = AddSeconds({1'000'000}, 0.1 * n);
    for (int k = 1; k <= 10; ++k) {
      const double t = 0.1 * (n - 1) + 0.01 * k;
      VehiclePose pose = flight.Pose(t);
      pose.time = AddSeconds({1'000'000}, t);
      bundle.poses.push_back(pose);
      ImuSample imu;
      imu.time = pose.time;
      imu.specific_force_B = flight.SpecificForce(t) + NormalVector(random, 0.02);
      bundle.imu.push_back(imu);
    }
    if (n % 2 == 0) {
      bundle.gps.push_back(FixAt(receiver, flight, 0.1 * n - 0.1, random));
    }
    navigator.AddSensors(bundle);
    if (n == 30 && site) {
      navigator.StartVision({}, bundle.time);
    }
    if (n > 30) {
      flown.error_m =
          (navigator.EstimateInForce(bundle.time).p_WB - flight.Position(0.1 * n)).norm();
      flown.worst_m = std::max(flown.worst_m, flown.error_m);
    }
  }
  flown.frame_moves = navigator.frame_moves();
  return flown;
}

TEST(Navigator, DoesNotFollowAGpsThatJumpsOrDrifts) {
  EXPECT_LT(FlyWith({}, true, 15).worst_m, 0.15);
  EXPECT_LT(FlyWith({.jump_m = 10}, true, 15).worst_m, 0.3);
  EXPECT_LT(FlyWith({.drift_mps = 0.5}, true, 15).worst_m, 0.6);
}

TEST(Navigator, TakesAGpsThatHasSettledElsewhereOnlyWithoutASite) {
  const Flown with_site = FlyWith({.jump_m = 10}, true, 25);
  EXPECT_EQ(with_site.frame_moves, 0);
  EXPECT_LT(with_site.error_m, 0.5);
  const Flown without = FlyWith({.jump_m = 10}, false, 25);
  EXPECT_EQ(without.frame_moves, 1) << "who keeps maps must know";
  EXPECT_NEAR(without.error_m, 10, 0.3);
}

TEST(Navigator, AJumpThatTheFilterRefusesNeverMovesATrackedSite) {
  for (const double jump_m : {2.5, 3.0, 4.0}) {
    const Flown flown = FlyWith({.sigma_m = 0.6, .jump_m = jump_m}, true, 25);
    EXPECT_EQ(flown.frame_moves, 0) << jump_m;
  }
  EXPECT_LT(FlyWith({.sigma_m = 0.6, .jump_m = 4}, true, 25).error_m, 1.0);
}

}  // namespace
}  // namespace palace
