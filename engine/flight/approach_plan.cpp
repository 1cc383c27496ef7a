#include "engine/flight/approach_plan.h"

#include <cmath>
#include <numbers>

#include "engine/core/frames.h"

namespace palace {

ApproachCourse ChooseCourse(const LandingSite& site, double straight_rad) {
  constexpr unsigned kSectors = 8;
  ApproachCourse chosen{straight_rad, false};
  if (site.corridor_clear) {
    return chosen;
  }
  double least_turn_rad = HUGE_VAL;
  for (unsigned sector = 0; sector < kSectors; ++sector) {
    if ((site.clear_approaches >> sector & 1U) == 0) {
      continue;
    }
    // Who comes from the north flies south.
    const double heading_rad =
        WrapAngle(sector * 2 * std::numbers::pi / kSectors + std::numbers::pi);
    const double turn_rad = std::abs(WrapAngle(heading_rad - straight_rad));
    if (turn_rad < least_turn_rad) {
      least_turn_rad = turn_rad;
      chosen = {heading_rad, true};
    }
  }
  return chosen;
}

}  // namespace palace
