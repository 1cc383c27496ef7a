// The simulated sensors. Each draws from a random stream of its own, named after it, so that one
// sensor's noise never depends on another's. Their figures stand in the vehicle's file; all 0 here:
// exact sensors.
#pragma once

#include <deque>
#include <optional>

#include "engine/core/random.h"
#include "engine/model/vehicle_state.h"
#include "engine/world/world.h"

namespace palace {

struct GpsNoise {
  double horizontal_m = 0;
  double vertical_m = 0;
  double velocity_mps = 0;
  double latency_s = 0;
};

/// Measures B (the antenna's lever arm is taken to be compensated).
class GpsSensor {
 public:
  GpsSensor(const GpsNoise& noise, std::uint64_t seed);
  void Measure(Timestamp now, const Eigen::Vector3d& p_WB, const Eigen::Vector3d& v_WB);
  /// A fix whose latency has passed, stamped with the time it is valid for.
  std::optional<GpsFix> Deliver(Timestamp now);

 private:
  GpsNoise noise_;
  RandomStream random_;
  std::deque<GpsFix> in_flight_;
};

struct ImuNoise {
  double gyro_rad_s_sqrt_hz = 0;
  double accel_mps2_sqrt_hz = 0;
  double gyro_bias_rad_s = 0;  ///< turn-on, standard deviation per axis
  double accel_bias_mps2 = 0;  ///< turn-on, standard deviation per axis
};

class ImuSensor {
 public:
  ImuSensor(const ImuNoise& noise, double rate_hz, std::uint64_t seed);
  ImuSample Measure(Timestamp now, const Eigen::Vector3d& specific_force_B,
                    const Eigen::Vector3d& angular_rate_B);
  const Eigen::Vector3d& gyro_bias() const { return gyro_bias_; }    ///< rad/s
  const Eigen::Vector3d& accel_bias() const { return accel_bias_; }  ///< m/s^2

 private:
  RandomStream random_;
  double gyro_sigma_;
  double accel_sigma_;
  Eigen::Vector3d gyro_bias_;
  Eigen::Vector3d accel_bias_;
};

struct AhrsNoise {
  double white_rad = 0;
  double bias_rad = 0;  ///< first-order Gauss-Markov
  double bias_time_s = 300;
};

/// Attitude: the true rotation followed by a small body rotation, white plus slow bias.
class AhrsSensor {
 public:
  AhrsSensor(const AhrsNoise& noise, double rate_hz, std::uint64_t seed);
  Eigen::Matrix3d Measure(const Eigen::Matrix3d& R_WB);

 private:
  AhrsNoise noise_;
  double decay_;
  RandomStream random_;
  Eigen::Vector3d bias_rad_;
};

struct LaserNoise {
  double sigma_m = 0;
  double sigma_per_m = 0;
  double quantum_m = 0.01;
  double dropout = 0;  ///< probability of no return
  double max_range_m = 60;
};

/// From the left focal point along the optical axis (thesis 2.2) to ground or object.
class LaserSensor {
 public:
  LaserSensor(const LaserNoise& noise, std::uint64_t seed);
  LaserRange Measure(Timestamp now, const World& world, const RigidTransform& X_WC);

 private:
  LaserNoise noise_;
  RandomStream random_;
};

}  // namespace palace
