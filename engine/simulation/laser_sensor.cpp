#include "engine/simulation/laser_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palace {

LaserSensor::LaserSensor(const LaserNoise& noise, std::uint64_t seed)
    : noise_(noise), random_(seed, "laser"), spike_random_(seed, "laser spikes") {}

double LaserSensor::TrueRange(const World& world, const RigidTransform& X_WC) const {
  double nearest_m = CastRay(world, X_WC.p, X_WC.R.col(2)).s;
  for (int ring = 1; noise_.footprint_rad > 0 && ring <= 2; ++ring) {
    const double off = std::tan(noise_.footprint_rad / 2) * ring / 2;
    const int rays = 6 * ring;
    for (int i = 0; i < rays; ++i) {
      const double turn = 2 * std::numbers::pi * i / rays;
      const Eigen::Vector3d ray_C(off * std::cos(turn), off * std::sin(turn), 1);
      nearest_m = std::min(nearest_m, CastRay(world, X_WC.p, X_WC.R * ray_C.normalized()).s);
    }
  }
  return nearest_m;
}

LaserRange LaserSensor::Measure(Timestamp now, const World& world, const RigidTransform& X_WC) {
  const double distance = TrueRange(world, X_WC);
  const double range = distance <= noise_.max_range_m ? distance : std::nan("");
  double noisy = range + (noise_.sigma_m + noise_.sigma_per_m * range) * random_.Normal();
  const bool lost = random_.Uniform() < noise_.dropout;
  const bool spike = spike_random_.Uniform() < noise_.spike, longer = spike_random_.Index(2) == 1;
  if (spike) {
    noisy = std::max(0.0, noisy + (longer ? noise_.spike_m : -noise_.spike_m));
  }
  LaserRange sample;
  sample.time = now;
  sample.range_m = lost ? std::nan("") : std::round(noisy / noise_.quantum_m) * noise_.quantum_m;
  return sample;
}

}  // namespace palace
