// ImuSensor: specific force and angular rate of B, as an inertial unit tells them.
//
//   out = quantise(limit(M (in + vibration) + b + s n)),  M = I + diag(scale) + misalignment
//   b   = turn-on bias + a random walk;  s = density * sqrt(rate)
//   vibration (specific force alone) = a sin(2 pi f t + phase) on each axis, phases drawn
//
// A line above half the rate appears folded, as it does in a unit without a filter before its
// sampler: 2/rev of the R-50 is about 29 Hz (870 rpm, two blades), which 50 Hz shows at 21 Hz.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/core/random.h"
#include "engine/model/vehicle_state.h"

namespace palace {

/// All 0 and unlimited: an exact unit. Scale, misalignment and turn-on bias are standard
/// deviations of what is drawn once.
struct ImuNoise {
  double gyro_rad_s_sqrt_hz = 0;
  double accel_mps2_sqrt_hz = 0;
  double gyro_bias_rad_s = 0;  ///< turn-on, standard deviation per axis
  double accel_bias_mps2 = 0;  ///< turn-on, standard deviation per axis
  double gyro_walk_rad_s2_sqrt_hz = 0;
  double accel_walk_mps3_sqrt_hz = 0;
  double gyro_scale = 0;  ///< share, per axis
  double accel_scale = 0;
  double misalignment_rad = 0;  ///< of each of the six angles between axes, both triads their own
  double gyro_limit_rad_s = std::numeric_limits<double>::infinity();
  double accel_limit_mps2 = std::numeric_limits<double>::infinity();
  double gyro_quantum_rad_s = 0;  ///< 0: none
  double accel_quantum_mps2 = 0;
  double vibration_mps2 = 0;  ///< amplitude on each axis
  double vibration_hz = 29;
};

/// Each error has a stream of its own.
class ImuSensor {
 public:
  ImuSensor(const ImuNoise& noise, double rate_hz, std::uint64_t seed);
  ImuSample Measure(Timestamp now, const Eigen::Vector3d& specific_force_B,
                    const Eigen::Vector3d& angular_rate_B);
  const Eigen::Vector3d& gyro_bias() const { return gyro_bias_; }    ///< rad/s, now
  const Eigen::Vector3d& accel_bias() const { return accel_bias_; }  ///< m/s^2, now

 private:
  Eigen::Vector3d Vibration(Timestamp now) const;

  ImuNoise noise_;
  double period_s_;
  RandomStream random_;
  RandomStream walk_random_;
  double gyro_sigma_;
  double accel_sigma_;
  Eigen::Vector3d gyro_bias_;
  Eigen::Vector3d accel_bias_;
  Eigen::Matrix3d gyro_gain_;
  Eigen::Matrix3d accel_gain_;
  Eigen::Vector3d vibration_phase_rad_;
};

}  // namespace palace
