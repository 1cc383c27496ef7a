// One clearing in ground that is full of hazards: `one`, where it is in sight, and `search`, where
// it is not.
#pragma once

#include <cstdint>

#include "engine/core/random.h"
#include "engine/world/families/drawing.h"
#include "engine/world/world.h"

namespace palace {

struct ClearingPlan {
  Range north_m, east_m;      ///< of its middle
  Eigen::Vector2d lattice_m;  ///< middle of the hazards, which reach `half_m` to every side
  double half_m;
  Eigen::Vector2d stones_low_m, stones_high_m;  ///< where some of them are stones
  Range stones;                                 ///< share of them
  int relief_levels;
  double relief_m, relief_north_m;
};

void DrawClearing(World& world, RandomStream& random, const ClearingPlan& plan);

/// A square of kSearchedHalf_m to every side of the origin, full of hazards, with one safe place
/// anywhere in it but its rim.
inline constexpr double kSearchedHalf_m = 40;
World MakeSearchedGround(std::uint64_t seed);

}  // namespace palace
