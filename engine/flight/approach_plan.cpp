#include "engine/flight/approach_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/frames.h"
#include "engine/core/units.h"

namespace palace {
namespace {

/// The straight course stands for the sector that it is in.
constexpr double kHalfSector_rad = std::numbers::pi / kApproachSectors;

/// Where one who flies that course comes from: [0, 2 pi) from north over east.
double Bearing(double heading_rad) {
  const double from_rad = WrapAngle(heading_rad + std::numbers::pi);
  return from_rad < -1e-9 ? from_rad + 2 * std::numbers::pi : std::max(from_rad, 0.0);
}

}  // namespace

std::vector<ApproachCourse> ClearCourses(const LandingSite& site, double straight_rad,
                                         bool straight_clear) {
  std::vector<ApproachCourse> clear;
  if (straight_clear) {
    clear.push_back({straight_rad, kStraightApproach});
  }
  for (int sector = 0; sector < kApproachSectors; ++sector) {
    const double heading_rad = HeadingFromSector(sector);
    const bool again =
        straight_clear && std::abs(WrapAngle(heading_rad - straight_rad)) < kHalfSector_rad;
    if ((site.clear_approaches >> sector & 1U) != 0 && !again) {
      clear.push_back({heading_rad, sector});
    }
  }
  std::stable_sort(clear.begin(), clear.end(),
                   [](const ApproachCourse& a, const ApproachCourse& b) {
                     return Bearing(a.heading_rad) < Bearing(b.heading_rad);
                   });
  return clear;
}

ApproachCourse ChooseCourse(const LandingSite& site, double straight_rad) {
  const ApproachCourse straight{straight_rad, kStraightApproach};
  if (site.corridor_clear) {
    return straight;
  }
  const auto turn_rad = [&](const ApproachCourse& course) {
    return std::abs(WrapAngle(course.heading_rad - straight_rad));
  };
  const std::vector<ApproachCourse> clear = ClearCourses(site, straight_rad, false);
  const auto least = std::min_element(
      clear.begin(), clear.end(),
      [&](const ApproachCourse& a, const ApproachCourse& b) { return turn_rad(a) < turn_rad(b); });
  return least == clear.end() ? straight : *least;
}

}  // namespace palace
