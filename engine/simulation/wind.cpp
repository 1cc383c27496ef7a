#include "engine/simulation/wind.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kReferenceHeight_ft = 20;
constexpr double kRoughnessLength_ft = 0.15;  // MIL-F-8785C, category C
constexpr double kSlowestAir_mps = 3;
constexpr double kGustPerMean = 1.5;

/// The model is stated in feet and holds from 10 ft to 1000 ft.
double ModelHeight_ft(double height_m) {
  return std::clamp(height_m / kMetresPerFoot, 10.0, 1000.0);
}

/// One step of s sqrt(T)(1 + sqrt(3) T s)/(1 + T s)^2 driven by white noise: a double pole at -1/T
/// in controller form, advanced by its exact transition matrix.
double AdvanceDoublePole(Eigen::Vector2d& x, double sigma, double T, double dt, double normal) {
  const double decay = std::exp(-dt / T), k = dt / T;
  const Eigen::Vector2d next(decay * ((1 + k) * x.x() + dt * x.y()),
                             decay * (-k / T * x.x() + (1 - k) * x.y()));
  x = next;
  x.y() += normal * sigma * std::sqrt(T / dt) * dt / (T * T);
  return x.x() + std::sqrt(3.0) * T * x.y();
}

}  // namespace

Eigen::Vector3d DrydenSigma(double gust_w20_mps, double height_above_ground_m) {
  const double h = ModelHeight_ft(height_above_ground_m);
  const double vertical = 0.1 * gust_w20_mps;
  const double horizontal = vertical / std::pow(0.177 + 0.000823 * h, 0.4);
  return {horizontal, horizontal, vertical};
}

WindOptions GustyWind(double mean_mps, double from_rad) {
  return {mean_mps, from_rad, kGustPerMean * mean_mps};
}

WindModel::WindModel(const WindOptions& options, std::uint64_t seed)
    : options_(options), random_(seed, "wind") {}

Eigen::Vector3d WindModel::Mean(double height_above_ground_m) const {
  const double h = ModelHeight_ft(height_above_ground_m);
  const double speed = options_.mean_mps * std::log(h / kRoughnessLength_ft) /
                       std::log(kReferenceHeight_ft / kRoughnessLength_ft);
  return {-speed * std::cos(options_.from_rad), -speed * std::sin(options_.from_rad), 0};
}

Eigen::Vector3d WindModel::Advance(double dt_s, double height_above_ground_m, double airspeed_mps) {
  const Eigen::Vector3d mean = Mean(height_above_ground_m);
  if (options_.gust_w20_mps <= 0) {
    return mean;
  }
  const double h = ModelHeight_ft(height_above_ground_m);
  const Eigen::Vector3d sigma = DrydenSigma(options_.gust_w20_mps, height_above_ground_m);
  const double speed = std::max({airspeed_mps, mean.norm(), kSlowestAir_mps});
  const double T_u = h / std::pow(0.177 + 0.000823 * h, 1.2) * kMetresPerFoot / speed;
  const double T_w = h * kMetresPerFoot / speed;
  const double decay = std::exp(-dt_s / T_u);
  u_ = decay * u_ + sigma.x() * std::sqrt(1 - decay * decay) * random_.Normal();
  const double v = AdvanceDoublePole(lateral_, sigma.y(), T_u, dt_s, random_.Normal());
  const double w = AdvanceDoublePole(vertical_, sigma.z(), T_w, dt_s, random_.Normal());
  // Gusts are defined along and across the mean wind.
  const double along = options_.from_rad + std::numbers::pi;
  const double c = std::cos(along), s = std::sin(along);
  return mean + Eigen::Vector3d(c * u_ - s * v, s * u_ + c * v, w);
}

}  // namespace palace
