#include "engine/simulation/gps_sensor.h"

#include <cmath>

#include "engine/simulation/normal_vector.h"

namespace palace {
namespace {

Eigen::Vector3d Deviations(double horizontal, double vertical) {
  return {horizontal, horizontal, vertical};
}

}  // namespace

GpsSensor::GpsSensor(const GpsNoise& noise, std::uint64_t seed)
    : noise_(noise),
      random_(seed, "gps"),
      drift_random_(seed, "gps drift"),
      jitter_random_(seed, "gps latency"),
      dropout_random_(seed, "gps dropout"),
      drift_W_(Deviations(noise.drift_horizontal_m, noise.drift_vertical_m)
                   .cwiseProduct(NormalVector(drift_random_))) {}

void GpsSensor::Drift(Timestamp now) {
  if (measured_) {
    const double decay = std::exp(-SecondsBetween(*measured_, now) / noise_.drift_time_s);
    drift_W_ = decay * drift_W_ + std::sqrt(1 - decay * decay) *
                                      Deviations(noise_.drift_horizontal_m, noise_.drift_vertical_m)
                                          .cwiseProduct(NormalVector(drift_random_));
  }
  measured_ = now;
}

void GpsSensor::Measure(Timestamp now, const Eigen::Vector3d& p_WB, const Eigen::Vector3d& v_WB) {
  Drift(now);
  const Eigen::Vector3d sigma = Deviations(noise_.horizontal_m, noise_.vertical_m);
  GpsFix fix;
  fix.time = now;
  fix.p_WB = p_WB + sigma.cwiseProduct(NormalVector(random_)) + drift_W_;
  fix.v_WB = v_WB + noise_.velocity_mps * NormalVector(random_);
  fix.sigma_horizontal_m = noise_.horizontal_m;
  fix.sigma_vertical_m = noise_.vertical_m;
  const double latency_s = noise_.latency_s + noise_.latency_jitter_s * jitter_random_.Uniform();
  if (!(dropout_random_.Uniform() < noise_.dropout)) {
    in_flight_.push_back({fix, latency_s});
  }
}

std::optional<GpsFix> GpsSensor::Deliver(Timestamp now) {
  if (in_flight_.empty() ||
      AddSeconds(in_flight_.front().fix.time, in_flight_.front().latency_s) > now) {
    return std::nullopt;
  }
  const GpsFix fix = in_flight_.front().fix;
  in_flight_.pop_front();
  return fix;
}

}  // namespace palace
