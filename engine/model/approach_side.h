// The sides from which a site may be approached: eight sectors, and straight from the vehicle.
//
// Sector k is that of bearing k * 45 degrees, from north over east: who approaches from sector 0
// comes from the north and flies south. LandingSite::clear_approaches has a bit for each.
#pragma once

#include <numbers>

#include "engine/core/frames.h"
#include "engine/model/landing_site.h"

namespace palace {

inline constexpr int kApproachSectors = 8;
/// On the straight line from where the vehicle is.
inline constexpr int kStraightApproach = -1;

/// Course over ground of who comes from that sector, rad in (-pi, pi].
inline double HeadingFromSector(int sector) {
  return WrapAngle(sector * 2 * std::numbers::pi / kApproachSectors + std::numbers::pi);
}

/// Whether it names a side at all.
constexpr bool IsApproachSide(int side) {
  return side >= kStraightApproach && side < kApproachSectors;
}

/// Some way to it is clear: straight, or round to a side.
inline bool IsReached(const LandingSite& site) {
  return site.corridor_clear || site.clear_approaches != 0;
}

}  // namespace palace
