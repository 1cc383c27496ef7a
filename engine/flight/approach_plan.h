// The course on which a site is approached: straight from where the vehicle is where nothing stands
// in that corridor, unless a clear sector suits wind and sun better by kWorthTurning or the
// straight way has too much tailwind; else from the clear sector that suits best, of equals the one
// that turns least. From north over east.
//
// Which corridors are clear is told by the maps (LandingSite::corridor_clear, clear_approaches).
// Source: thesis chapter 1.3 (the approach keeps clear of what interferes with the glide slope).
#pragma once

#include <bitset>
#include <vector>

#include "engine/model/approach_side.h"
#include "engine/model/landing_site.h"
#include "engine/model/mission/heading_curve.h"

namespace palace {

struct ApproachCourse {
  double heading_rad = 0;        ///< (-pi, pi]
  int side = kStraightApproach;  ///< that it comes from
};

/// Of the combined score: what going round must gain.
inline constexpr double kWorthTurning = 0.15;

/// The 72 courses of which the maps call the corridor clear, as conditions for ScoreHeadings: those
/// of a clear sector, and the nearest to the straight one where that is clear.
std::bitset<kApproachHeadings> BlockedHeadings(const LandingSite& site, double straight_rad);

/// `straight_rad`: the course from the vehicle to the site, which `curve` takes for the wanted one.
/// Where no corridor is clear it stays the straight one, which is refused for what stands in it.
/// Where that one is not known (NaN), any clear sector is preferred to it.
ApproachCourse ChooseCourse(const LandingSite& site, double straight_rad,
                            const HeadingCurve& curve);

/// The clear sectors and, where `straight_clear`, the straight course: by the bearing that they
/// come from, clockwise from north. The straight one stands for the sector that it is in.
std::vector<ApproachCourse> ClearCourses(const LandingSite& site, double straight_rad,
                                         bool straight_clear);

}  // namespace palace
