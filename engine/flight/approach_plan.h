// The course on which a site is approached: straight from where the vehicle is when nothing stands
// in that corridor, otherwise from the clear sector that turns least from it. From north over east.
//
// Which corridors are clear is told by the maps (LandingSite::corridor_clear, clear_approaches).
// Source: thesis chapter 1.3 (the approach keeps clear of what interferes with the glide slope).
#pragma once

#include "engine/model/landing_site.h"

namespace palace {

struct ApproachCourse {
  double heading_rad = 0;  ///< (-pi, pi]
  bool turned = false;     ///< not the straight one
};

/// `straight_rad`: the course from the vehicle to the site. Where no corridor is clear it stays the
/// straight one, which is refused for what stands in it.
ApproachCourse ChooseCourse(const LandingSite& site, double straight_rad);

}  // namespace palace
