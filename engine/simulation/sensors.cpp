#include "engine/simulation/sensors.h"

#include <cmath>

#include "engine/world/world.h"

namespace palace {
namespace {

Eigen::Vector3d NormalVector(RandomStream& random) {
  // Named, because the order in which arguments are evaluated is not defined.
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return {x, y, z};
}

}  // namespace

GpsSensor::GpsSensor(const GpsNoise& noise, std::uint64_t seed)
    : noise_(noise), random_(seed, "gps") {}

void GpsSensor::Measure(Timestamp now, const Eigen::Vector3d& p_WB, const Eigen::Vector3d& v_WB) {
  const Eigen::Vector3d sigma(noise_.horizontal_m, noise_.horizontal_m, noise_.vertical_m);
  GpsFix fix;
  fix.time = now;
  fix.p_WB = p_WB + sigma.cwiseProduct(NormalVector(random_));
  fix.v_WB = v_WB + noise_.velocity_mps * NormalVector(random_);
  fix.sigma_horizontal_m = noise_.horizontal_m;
  fix.sigma_vertical_m = noise_.vertical_m;
  in_flight_.push_back(fix);
}

std::optional<GpsFix> GpsSensor::Deliver(Timestamp now) {
  if (in_flight_.empty() || AddSeconds(in_flight_.front().time, noise_.latency_s) > now) {
    return std::nullopt;
  }
  const GpsFix fix = in_flight_.front();
  in_flight_.pop_front();
  return fix;
}

ImuSensor::ImuSensor(const ImuNoise& noise, double rate_hz, std::uint64_t seed)
    : random_(seed, "imu"),
      gyro_sigma_(noise.gyro_rad_s_sqrt_hz * std::sqrt(rate_hz)),
      accel_sigma_(noise.accel_mps2_sqrt_hz * std::sqrt(rate_hz)),
      gyro_bias_(noise.gyro_bias_rad_s * NormalVector(random_)),
      accel_bias_(noise.accel_bias_mps2 * NormalVector(random_)) {}

ImuSample ImuSensor::Measure(Timestamp now, const Eigen::Vector3d& specific_force_B,
                             const Eigen::Vector3d& angular_rate_B) {
  ImuSample sample;
  sample.time = now;
  sample.specific_force_B = specific_force_B + accel_bias_ + accel_sigma_ * NormalVector(random_);
  sample.angular_rate_B = angular_rate_B + gyro_bias_ + gyro_sigma_ * NormalVector(random_);
  return sample;
}

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

LaserSensor::LaserSensor(const LaserNoise& noise, std::uint64_t seed)
    : noise_(noise), random_(seed, "laser") {}

LaserRange LaserSensor::Measure(Timestamp now, const World& world, const RigidTransform& X_WC) {
  const double distance = CastRay(world, X_WC.p, X_WC.R.col(2)).s;
  const double range = distance <= noise_.max_range_m ? distance : std::nan("");
  const double noisy = range + (noise_.sigma_m + noise_.sigma_per_m * range) * random_.Normal();
  const bool lost = random_.Uniform() < noise_.dropout;
  LaserRange sample;
  sample.time = now;
  sample.range_m = lost ? std::nan("") : std::round(noisy / noise_.quantum_m) * noise_.quantum_m;
  return sample;
}

}  // namespace palace
