// Each error of IMU, GPS, laser, attitude and clock against what it must be in closed form, and
// that none changes what another draws.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "engine/simulation/gps_sensor.h"
#include "engine/simulation/imu_sensor.h"
#include "engine/simulation/laser_sensor.h"
#include "tests/simulation/simulated_station.h"

namespace palace {
namespace {

const Vector3d kZero = Vector3d::Zero();

/// Standard deviation about 0, of all axes together.
class Spread {
 public:
  void Add(double value) { squares_ += value * value, ++count_; }
  void Add(const Vector3d& value) {
    for (const double v : value) {
      Add(v);
    }
  }
  double sigma() const { return std::sqrt(squares_ / count_); }
  /// Four standard deviations of sigma() / truth.
  double interval() const { return 4 / std::sqrt(2.0 * count_); }

 private:
  double squares_ = 0;
  int count_ = 0;
};

ImuSample One(const ImuNoise& noise, std::uint64_t seed, const Vector3d& force = kZero,
              const Vector3d& rate = kZero) {
  return ImuSensor(noise, 100, seed).Measure({}, force, rate);
}

TEST(ImuErrors, ScaleAndMisalignmentAreDrawnOnceWithTheirDeviation) {
  const ImuNoise noise{.gyro_scale = 0.003, .accel_scale = 0.002, .misalignment_rad = 0.004};
  Spread gyro_scale, accel_scale, angles;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    for (int axis = 0; axis < 3; ++axis) {
      const ImuSample sample =
          One(noise, seed, 10 * Vector3d::Unit(axis), 2 * Vector3d::Unit(axis));
      for (int out = 0; out < 3; ++out) {
        const double force = sample.specific_force_B[out] / 10;
        const double rate = sample.angular_rate_B[out] / 2;
        if (out == axis) {
          gyro_scale.Add(rate - 1), accel_scale.Add(force - 1);
        } else {
          angles.Add(rate), angles.Add(force);
        }
      }
    }
  }
  EXPECT_NEAR(gyro_scale.sigma() / 0.003, 1, gyro_scale.interval());
  EXPECT_NEAR(accel_scale.sigma() / 0.002, 1, accel_scale.interval());
  EXPECT_NEAR(angles.sigma() / 0.004, 1, angles.interval());
}

TEST(ImuErrors, SaturationHoldsAndTheGridRounds) {
  const ImuNoise noise{.gyro_limit_rad_s = 3,
                       .accel_limit_mps2 = 20,
                       .gyro_quantum_rad_s = 0.01,
                       .accel_quantum_mps2 = 0.05};
  const ImuSample high = One(noise, 1, {100, -100, 1.026}, {5, -5, 0.0149});
  EXPECT_TRUE(high.specific_force_B.isApprox(Vector3d(20, -20, 1.05), 1e-12));
  EXPECT_TRUE(high.angular_rate_B.isApprox(Vector3d(3, -3, 0.01), 1e-12));
}

// After t seconds a walk of density w has the deviation w sqrt(t).
TEST(ImuErrors, BiasWalksWithTheRootOfTime) {
  const ImuNoise noise{.gyro_walk_rad_s2_sqrt_hz = 1e-4, .accel_walk_mps3_sqrt_hz = 2e-3};
  Spread gyro, accel;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    ImuSensor imu(noise, 100, seed);
    for (int i = 0; i < 900; ++i) {
      imu.Measure({i}, kZero, kZero);
    }
    gyro.Add(imu.gyro_bias()), accel.Add(imu.accel_bias());
  }
  EXPECT_NEAR(gyro.sigma() / (1e-4 * 3), 1, gyro.interval());
  EXPECT_NEAR(accel.sigma() / (2e-3 * 3), 1, accel.interval());
}

/// Amplitude of a line in the first axis of a series.
double LineAt(const std::vector<double>& series, double rate_hz, double line_hz) {
  double c = 0, s = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double turned = 2 * std::numbers::pi * line_hz * static_cast<double>(i) / rate_hz;
    c += series[i] * std::cos(turned), s += series[i] * std::sin(turned);
  }
  return 2 * std::hypot(c, s) / static_cast<double>(series.size());
}

// 29 Hz sampled 100 times a second is at 29 Hz; 50 times a second, at 21 Hz.
TEST(ImuErrors, VibrationIsALineThatTheRateFolds) {
  for (const auto& [rate_hz, seen_hz] : {std::pair(100.0, 29.0), std::pair(50.0, 21.0)}) {
    ImuSensor imu({.vibration_mps2 = 0.8}, rate_hz, 3);
    std::vector<double> series;
    for (int i = 0; i < 20 * rate_hz; ++i) {
      series.push_back(imu.Measure(AddSeconds({}, i / rate_hz), kZero, kZero).specific_force_B.x());
    }
    EXPECT_NEAR(LineAt(series, rate_hz, seen_hz), 0.8, 0.01) << rate_hz;
    EXPECT_LT(LineAt(series, rate_hz, 13), 0.01) << rate_hz;
  }
}

TEST(ImuErrors, NoneChangesTheWhiteNoise) {
  const ImuNoise plain{.gyro_rad_s_sqrt_hz = 1e-3, .accel_mps2_sqrt_hz = 1e-2};
  ImuNoise all = plain;
  all.gyro_walk_rad_s2_sqrt_hz = all.accel_walk_mps3_sqrt_hz = 1e-12;  // on, and too small to see
  all.gyro_scale = all.accel_scale = all.misalignment_rad = 1e-12;
  all.vibration_mps2 = 1e-12;
  ImuSensor a(plain, 100, 9), b(all, 100, 9);
  for (int i = 0; i < 50; ++i) {
    const ImuSample x = a.Measure({i}, {0, 0, -9.8}, kZero),
                    y = b.Measure({i}, {0, 0, -9.8}, kZero);
    EXPECT_LT((x.specific_force_B - y.specific_force_B).norm(), 1e-9);
    EXPECT_LT((x.angular_rate_B - y.angular_rate_B).norm(), 1e-9);
  }
}

/// Errors of fixes 0.2 s apart; each as soon as it comes.
std::vector<GpsFix> Fixes(const GpsNoise& noise, std::uint64_t seed, int count) {
  GpsSensor gps(noise, seed);
  std::vector<GpsFix> fixes;
  for (int i = 0; i < 40 * (count + 5); ++i) {
    const Timestamp now{5000 * i};
    if (i % 40 == 0 && i < 40 * count) {
      gps.Measure(now, kZero, kZero);
    }
    if (const auto fix = gps.Deliver(now)) {
      fixes.push_back(*fix);
    }
  }
  return fixes;
}

// Stationary variance d^2, covariance d^2 e^(-tau/T).
TEST(GpsErrors, DriftIsAGaussMarkovProcess) {
  const GpsNoise noise{.drift_horizontal_m = 2, .drift_vertical_m = 3, .drift_time_s = 10};
  Spread horizontal, vertical;
  double product = 0;
  constexpr int kSeeds = 3000, kLag = 25;  // 5 s
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<GpsFix> fixes = Fixes(noise, seed, kLag + 1);
    ASSERT_EQ(fixes.size(), kLag + 1u);
    horizontal.Add(fixes.back().p_WB.x()), horizontal.Add(fixes.back().p_WB.y());
    vertical.Add(fixes.back().p_WB.z());
    product += fixes.front().p_WB.x() * fixes.back().p_WB.x();
  }
  EXPECT_NEAR(horizontal.sigma() / 2, 1, horizontal.interval());
  EXPECT_NEAR(vertical.sigma() / 3, 1, vertical.interval());
  EXPECT_NEAR(product / kSeeds / 4, std::exp(-0.5), 4 * std::sqrt(1.4 / kSeeds));
}

// Delivered between latency and latency + jitter, stamped when measured, in order.
TEST(GpsErrors, JitterDelaysDeliveryNotTheStamp) {
  const GpsNoise noise{.latency_s = 0.1, .latency_jitter_s = 0.5};
  GpsSensor gps(noise, 4);
  double sum = 0, last_s = -1;
  int came = 0;
  for (int i = 0; i < 200 * 400; ++i) {
    const Timestamp now{5000 * i};
    if (i % 200 == 0) {
      gps.Measure(now, kZero, kZero);
    }
    if (const auto fix = gps.Deliver(now)) {
      const double late_s = SecondsBetween(fix->time, now);
      EXPECT_EQ(fix->time.us % 1'000'000, 0);
      EXPECT_GT(SecondsBetween({}, fix->time), last_s);
      last_s = SecondsBetween({}, fix->time);
      EXPECT_GE(late_s, 0.1 - 1e-9);
      EXPECT_LE(late_s, 0.6 + 0.005);
      sum += late_s, ++came;
    }
  }
  EXPECT_GE(came, 399);
  EXPECT_NEAR(sum / came, 0.1 + 0.25 + 0.0025, 4 * 0.5 / std::sqrt(12.0 * came));
}

TEST(GpsErrors, DropoutIsAsOftenAsStatedAndNoneChangesTheWhiteNoise) {
  const GpsNoise plain{.horizontal_m = 0.02, .vertical_m = 0.02, .velocity_mps = 0.03};
  GpsNoise all = plain;
  all.dropout = 0.2;
  all.latency_jitter_s = 0.1;
  all.drift_horizontal_m = all.drift_vertical_m = 1e-12;
  const std::vector<GpsFix> whole = Fixes(plain, 5, 4000), some = Fixes(all, 5, 4000);
  EXPECT_NEAR(static_cast<double>(some.size()) / 4000, 0.8, 4 * std::sqrt(0.16 / 4000));
  for (const GpsFix& fix : some) {
    const GpsFix& same = whole[static_cast<std::size_t>(fix.time.us / 200'000)];
    ASSERT_EQ(same.time, fix.time);
    ASSERT_LT((same.p_WB - fix.p_WB).norm(), 1e-9);
    ASSERT_EQ(same.v_WB, fix.v_WB);
  }
}

// A box 2 m high whose wall stands 0.1 m north of the axis, 20 m above the ground: the spot of
// 20 mrad has a radius of 0.18 m at the height of its roof.
TEST(LaserErrors, AFootprintTellsTheNearestOfItsSpot) {
  World world;
  world.solids = {StandingOn(world.ground, Box{1, 1, 2}, 0.6, 0)};
  const RigidTransform X_WC{CameraRotationFromTilt(-Rad(90)), {0, 0, -20}};
  const auto range = [&](double footprint_rad, double north_m) {
    RigidTransform moved = X_WC;
    moved.p.x() += north_m;
    LaserSensor laser({.quantum_m = 1e-4, .footprint_rad = footprint_rad}, 1);
    return laser.Measure({}, world, moved).range_m;
  };
  EXPECT_NEAR(range(0, 0), 20, 1e-3) << "one ray misses it";
  EXPECT_NEAR(range(0.02, 0), 18, 0.01) << "the rim of the spot does not";
  EXPECT_NEAR(range(0.02, -0.1), 20, 0.01) << "0.2 m away the spot is off it";
  // Slanted ground: short by half the spot times the tangent of the slant.
  World plain;
  LaserSensor slanted({.quantum_m = 1e-4, .footprint_rad = 0.0025}, 1);
  const RigidTransform X_W45{CameraRotationFromTilt(-Rad(45)), {0, 0, -15}};
  const double axis_m = 15 * std::sqrt(2.0);
  EXPECT_NEAR(axis_m - slanted.Measure({}, plain, X_W45).range_m, axis_m * 0.00125, 2e-3);
}

TEST(LaserErrors, SpikesAreAsOftenAndAsLargeAsStatedAndChangeNothingElse) {
  const World plain;
  const RigidTransform X_WC{CameraRotationFromTilt(-Rad(90)), {0, 0, -15}};
  const LaserNoise noise{.sigma_m = 0.03, .quantum_m = 1e-3, .dropout = 0.02};
  LaserNoise spiky = noise;
  spiky.spike = 0.05, spiky.spike_m = 4;
  LaserSensor a(noise, 2), b(spiky, 2);
  int up = 0, down = 0, lost = 0;
  constexpr int kReadings = 8000;
  for (int i = 0; i < kReadings; ++i) {
    const double x = a.Measure({i}, plain, X_WC).range_m, y = b.Measure({i}, plain, X_WC).range_m;
    ASSERT_EQ(std::isnan(x), std::isnan(y));
    lost += std::isnan(x) ? 1 : 0;
    if (!std::isnan(x) && x != y) {
      ASSERT_NEAR(std::abs(y - x), 4, 1.01e-3);
      ++(y > x ? up : down);
    }
  }
  const double share = static_cast<double>(up + down) / (kReadings - lost);
  EXPECT_NEAR(share, 0.05, 4 * std::sqrt(0.05 * 0.95 / kReadings));
  EXPECT_NEAR(up, down, 4 * std::sqrt(up + down));
}

// Poses reach the station late with their own stamps; the vehicle flies as ever.
TEST(AttitudeErrors, DelayIsOfWhatTheStationIsTold) {
  SimulatorOptions options = Options(8), late = options;
  late.vehicle.sensors.attitude.delay_s = 0.15;
  Flight a(options), b(late);
  std::vector<VehiclePose> told, told_late;
  for (int i = 0; i < 30; ++i) {
    const Bundle x = a.Step(), y = b.Step();
    EXPECT_EQ(x->truth.back().X_WB.p, y->truth.back().X_WB.p);
    EXPECT_EQ(y->pose_at_exposure->time, y->time) << "carried forward to the pictures";
    EXPECT_LT((x->pose_at_exposure->X_WB.p - y->pose_at_exposure->X_WB.p).norm(), 0.05);
    EXPECT_NEAR(SecondsBetween(y->poses.back().time, y->time), 0.15, 0.0201);
    told.insert(told.end(), x->poses.begin(), x->poses.end());
    told_late.insert(told_late.end(), y->poses.begin(), y->poses.end());
  }
  for (const VehiclePose& pose : told_late) {
    for (const VehiclePose& same : told) {
      if (same.time == pose.time) {
        EXPECT_EQ(same.X_WB.R, pose.X_WB.R);
      }
    }
  }
}

TEST(ClockErrors, StampsGainWhatTheFileSays) {
  SimulatorOptions options = Options(8);
  options.vehicle.clock_drift = 100e-6;
  Flight flight(options);
  const Bundle last = flight.StepSeconds(60);
  const double true_s = 60.1;  // the first bundle came at 0.1 s
  EXPECT_NEAR(SecondsBetween(Simulator::kEpoch, last->time), true_s * (1 + 100e-6), 2e-6);
  EXPECT_EQ(last->imu.back().time, last->time);
  EXPECT_EQ(last->poses.back().time, last->time);
  EXPECT_EQ(last->truth.back().time, last->time);
  EXPECT_LT((last->truth.back().X_WB.p - Vector3d(0, 0, -15.24)).norm(), 0.1) << "it hovers on";
}

// Errors of one sensor change no number that another told in the same flight. Those that the
// vehicle flies by (IMU, GPS) change the flight itself, so they are left to the tests above.
TEST(SensorErrors, CameraAndLaserErrorsChangeNoOtherSensor) {
  SimulatorOptions options = Options(9), worn = options;
  worn.vehicle.sensors.camera.latency_s = 0.07;
  worn.vehicle.sensors.camera.dropped = 0.5;
  worn.vehicle.sensors.laser.spike = 0.5;
  worn.vehicle.sensors.laser.spike_m = 3;
  worn.vehicle.sensors.laser.footprint_rad = 0.003;
  Flight a(options), b(worn);
  for (int i = 0; i < 50; ++i) {
    const Bundle x = a.Step(), y = b.Step();
    ASSERT_EQ(x->imu.size(), y->imu.size());
    for (std::size_t k = 0; k < x->imu.size(); ++k) {
      ASSERT_EQ(x->imu[k].specific_force_B, y->imu[k].specific_force_B);
      ASSERT_EQ(x->imu[k].angular_rate_B, y->imu[k].angular_rate_B);
    }
    ASSERT_EQ(x->gps.size(), y->gps.size());
    for (std::size_t k = 0; k < x->gps.size(); ++k) {
      ASSERT_EQ(x->gps[k].p_WB, y->gps[k].p_WB);
    }
    ASSERT_EQ(x->poses.back().X_WB.R, y->poses.back().X_WB.R);
    EXPECT_NEAR(SecondsBetween(y->pose_at_exposure->time, y->time), 0.07, 1e-9);
  }
}

}  // namespace
}  // namespace palace
