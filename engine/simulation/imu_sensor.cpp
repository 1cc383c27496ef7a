#include "engine/simulation/imu_sensor.h"

#include <cmath>
#include <numbers>

#include "engine/simulation/normal_vector.h"

namespace palace {
namespace {

Eigen::Vector3d Digitised(const Eigen::Vector3d& value, double limit, double quantum) {
  const Eigen::Vector3d held = value.cwiseMax(-limit).cwiseMin(limit);
  return quantum > 0 ? Eigen::Vector3d((held / quantum).array().round() * quantum) : held;
}

}  // namespace

ImuSensor::ImuSensor(const ImuNoise& noise, double rate_hz, std::uint64_t seed)
    : noise_(noise),
      period_s_(1 / rate_hz),
      random_(seed, "imu"),
      walk_random_(seed, "imu bias walk"),
      gyro_sigma_(noise.gyro_rad_s_sqrt_hz * std::sqrt(rate_hz)),
      accel_sigma_(noise.accel_mps2_sqrt_hz * std::sqrt(rate_hz)),
      gyro_bias_(noise.gyro_bias_rad_s * NormalVector(random_)),
      accel_bias_(noise.accel_bias_mps2 * NormalVector(random_)) {
  RandomStream scale(seed, "imu scale"), angles(seed, "imu misalignment"),
      phases(seed, "imu vibration");
  const auto gain = [&](double of_scale) {
    Eigen::Matrix3d M = Eigen::Matrix3d::Identity();
    M.diagonal() += of_scale * NormalVector(scale);
    for (const auto& [row, col] : {std::pair(0, 1), {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}) {
      M(row, col) = noise.misalignment_rad * angles.Normal();
    }
    return M;
  };
  gyro_gain_ = gain(noise.gyro_scale);
  accel_gain_ = gain(noise.accel_scale);
  for (double& phase : vibration_phase_rad_) {
    phase = phases.Uniform(0, 2 * std::numbers::pi);
  }
}

Eigen::Vector3d ImuSensor::Vibration(Timestamp now) const {
  const double turned_rad =
      2 * std::numbers::pi * noise_.vibration_hz * SecondsBetween(Timestamp{}, now);
  return noise_.vibration_mps2 * (vibration_phase_rad_.array() + turned_rad).sin();
}

ImuSample ImuSensor::Measure(Timestamp now, const Eigen::Vector3d& specific_force_B,
                             const Eigen::Vector3d& angular_rate_B) {
  Eigen::Vector3d force_B = specific_force_B;
  if (noise_.vibration_mps2 > 0) {
    force_B += Vibration(now);
  }
  const Eigen::Vector3d force = accel_gain_ * force_B, rate = gyro_gain_ * angular_rate_B;
  ImuSample sample;
  sample.time = now;
  sample.specific_force_B = Digitised(force + accel_bias_ + accel_sigma_ * NormalVector(random_),
                                      noise_.accel_limit_mps2, noise_.accel_quantum_mps2);
  sample.angular_rate_B = Digitised(rate + gyro_bias_ + gyro_sigma_ * NormalVector(random_),
                                    noise_.gyro_limit_rad_s, noise_.gyro_quantum_rad_s);
  gyro_bias_ += noise_.gyro_walk_rad_s2_sqrt_hz * std::sqrt(period_s_) * NormalVector(walk_random_);
  accel_bias_ += noise_.accel_walk_mps3_sqrt_hz * std::sqrt(period_s_) * NormalVector(walk_random_);
  return sample;
}

}  // namespace palace
