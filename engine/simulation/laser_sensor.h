// LaserSensor: a pulsed range finder from the left focal point along the optical axis (thesis 2.2)
// to ground or object.
//
// With a footprint the nearest return of the spot counts: such rangers stop their clock at the
// leading edge of the first echo, so a kerb or post in a corner of the spot is what they tell, and
// slanted ground reads short by half the spot times the tangent of its slant (2.6 cm at 21 m, 45
// degrees, 2.5 mrad). The spot is the axis and two rings of 6 and 12 rays.
#pragma once

#include <cstdint>

#include "engine/core/random.h"
#include "engine/model/vehicle_state.h"
#include "engine/world/world.h"

namespace palace {

struct LaserNoise {
  double sigma_m = 0;
  double sigma_per_m = 0;
  double quantum_m = 0.01;
  double dropout = 0;  ///< probability of no return
  double max_range_m = 60;
  double footprint_rad = 0;  ///< full angle of the beam; 0: one ray
  double spike = 0;          ///< probability of a reading off by spike_m, to either side
  double spike_m = 0;
};

/// Spikes draw from a stream of their own. They never read below 0.
class LaserSensor {
 public:
  LaserSensor(const LaserNoise& noise, std::uint64_t seed);
  LaserRange Measure(Timestamp now, const World& world, const RigidTransform& X_WC);

 private:
  double TrueRange(const World& world, const RigidTransform& X_WC) const;

  LaserNoise noise_;
  RandomStream random_;
  RandomStream spike_random_;
};

}  // namespace palace
