#include "engine/simulation/attitude_sensor.h"

#include <cmath>

#include "engine/simulation/normal_vector.h"

namespace palace {

AhrsSensor::AhrsSensor(const AhrsNoise& noise, double rate_hz, std::uint64_t seed)
    : noise_(noise),
      decay_(std::exp(-1 / (rate_hz * noise.bias_time_s))),
      random_(seed, "ahrs"),
      bias_rad_(noise.bias_rad * NormalVector(random_)) {}

Eigen::Matrix3d AhrsSensor::Measure(const Eigen::Matrix3d& R_WB) {
  bias_rad_ =
      decay_ * bias_rad_ + noise_.bias_rad * std::sqrt(1 - decay_ * decay_) * NormalVector(random_);
  const Eigen::Vector3d error = bias_rad_ + noise_.white_rad * NormalVector(random_);
  return R_WB * Eigen::AngleAxisd(error.norm(), error.normalized()).toRotationMatrix();
}

}  // namespace palace
