// The course on which a site is approached: straight from where the vehicle is when nothing stands
// in that corridor, otherwise from the clear sector that turns least from it. From north over east.
//
// Which corridors are clear is told by the maps (LandingSite::corridor_clear, clear_approaches).
// Source: thesis chapter 1.3 (the approach keeps clear of what interferes with the glide slope).
#pragma once

#include <vector>

#include "engine/model/approach_side.h"
#include "engine/model/landing_site.h"

namespace palace {

struct ApproachCourse {
  double heading_rad = 0;        ///< (-pi, pi]
  int side = kStraightApproach;  ///< that it comes from
};

/// `straight_rad`: the course from the vehicle to the site. Where no corridor is clear it stays the
/// straight one, which is refused for what stands in it.
ApproachCourse ChooseCourse(const LandingSite& site, double straight_rad);

/// The clear sectors and, where `straight_clear`, the straight course: by the bearing that they
/// come from, clockwise from north. The straight one stands for the sector that it is in.
std::vector<ApproachCourse> ClearCourses(const LandingSite& site, double straight_rad,
                                         bool straight_clear);

}  // namespace palace
