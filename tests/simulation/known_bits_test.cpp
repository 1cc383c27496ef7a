// The R-50 as its file tells it flies, measures and sees today what it did before its sensors could
// err in more ways: a key that is left out changes no bit. With all of them on one seed is one
// flight.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "engine/core/hash.h"
#include "engine/simulation/vehicle_file.h"
#include "tests/simulation/simulated_station.h"
#include "tests/support/ray_cast_camera.h"

namespace palace {
namespace {

bool HasFusedMultiplyAdd() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

template <typename Numbers>
void Add(ContentHash& hash, Timestamp time, const Numbers& numbers) {
  hash.Add(time.us);
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    hash.Add(numbers.data()[i]);
  }
}

void Add(ContentHash& hash, const ImageU8& picture) {
  for (const std::uint8_t pixel : picture.pixels()) {
    hash.Add(static_cast<std::uint64_t>(pixel));
  }
}

void Add(ContentHash& hash, const FrameBundle& b) {
  hash.Add(b.time.us);
  if (b.pose_at_exposure) {
    Add(hash, b.pose_at_exposure->time, b.pose_at_exposure->X_WB.R);
  }
  for (const VehiclePose& pose : b.poses) {
    Add(hash, pose.time, pose.X_WB.R);
    Add(hash, pose.time, pose.X_WB.p);
  }
  for (const ImuSample& imu : b.imu) {
    Add(hash, imu.time, imu.specific_force_B);
    Add(hash, imu.time, imu.angular_rate_B);
  }
  for (const GpsFix& fix : b.gps) {
    Add(hash, fix.time, fix.p_WB);
    Add(hash, fix.time, fix.v_WB);
  }
  for (const LaserRange& laser : b.laser) {
    hash.Add(laser.time.us);
    hash.Add(laser.range_m);
  }
  for (const Truth& truth : b.truth) {
    Add(hash, truth.time, truth.X_WB.p);
  }
  if (b.stereo) {
    hash.Add(b.stereo->time.us);
    Add(hash, b.stereo->left);
    Add(hash, b.stereo->right);
  }
}

TEST(KnownBits, TheR50FliesMeasuresAndSeesAsItAlwaysDid) {
  if (!HasFusedMultiplyAdd()) {
    GTEST_SKIP() << "runs on x86-64 with AVX2 and FMA, whose hash is known";
  }
  SimulatorOptions options = Options(21);
  options.wind = {3, 1, 5};
  ContentHash hash;
  {
    Flight flight(options);
    flight.Send(flight.MakeApproval({15, 2, 0}));
    flight.estimates_on = true;
    for (int i = 0; i < 300; ++i) {
      Add(hash, *flight.Step());
    }
  }
  options.render = true;
  Simulator simulator(options, MakeRayCastCamera);
  for (int i = 0; i < 3; ++i) {
    Add(hash, *simulator.Next({}).value());
  }
  EXPECT_EQ(hash.value(), 2034160962518400644u);
}

/// What the fuzzer starts from: every error on.
VehicleDescription Worn() {
  return LoadVehicle(PALACE_SOURCE_DIR "/tests/fuzz/corpus/vehicle/worn.toml").value();
}

TEST(KnownBits, WithEveryErrorOnOneSeedIsStillOneFlight) {
  const auto fly = [](std::uint64_t seed) {
    SimulatorOptions options = Options(seed);
    options.vehicle = Worn();
    options.wind = {3, 1, 5};
    options.render = true;
    Simulator simulator(options, MakeRayCastCamera);
    ContentHash hash;
    for (int i = 0; i < 2; ++i) {
      Add(hash, *simulator.Next({}).value());
    }
    return hash.value();
  };
  const std::uint64_t once = fly(31);
  EXPECT_EQ(once, fly(31));
  EXPECT_NE(once, fly(32));
}

// Its GPS wanders by 0.3 m north and east and 0.5 m up, one standard deviation, and it with it.
TEST(KnownBits, WithEveryErrorOnItHoversWhereItsGpsSays) {
  SimulatorOptions options = Options(33);
  options.vehicle = Worn();
  Flight flight(options);
  double worst_m = 0;
  for (int i = 0; i < 600; ++i) {
    for (const Truth& truth : flight.Step()->truth) {
      worst_m = std::max(worst_m, (truth.X_WB.p - Vector3d(0, 0, -15.24)).norm());
    }
  }
  EXPECT_LT(worst_m, 4 * std::hypot(0.3, 0.3, 0.5));
  EXPECT_GT(worst_m, 0.1) << "more than an unworn one in calm air";
}

}  // namespace
}  // namespace palace
