// Ground effect of a hovering rotor: near the ground the same power lifts more.
//   T / T_free = 1 / (1 - (R / 4 z)^2),   z = height of the rotor above the ground, z / R > 0.5
// Source: I. Cheeseman, W. Bennett, "The Effect of the Ground on a Helicopter Rotor in Forward
// Flight", ARC R&M 3021, 1955, without forward speed. Below z / R = 0.5 the value there stands. For
// four small rotors it is applied with the radius of one: a lower bound, as they do not help each
// other here.
#pragma once

#include <algorithm>

namespace palace {

struct GroundEffect {
  bool on = false;
  double rotor_radius_m = 0;
  double rotor_above_body_m = 0;  ///< above B
};

/// 1 where it is off. `height_m`: of B above the ground.
inline double ThrustRatio(const GroundEffect& effect, double height_m) {
  if (!effect.on) {
    return 1;
  }
  const double radius_m = effect.rotor_radius_m;
  const double z_m = std::max(height_m + effect.rotor_above_body_m, 0.5 * radius_m);
  const double near = radius_m / (4 * z_m);
  return 1 / (1 - near * near);
}

}  // namespace palace
