#include "engine/flight/approach_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/core/frames.h"
#include "engine/flight/approach_heading.h"

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

std::bitset<kApproachHeadings> BlockedHeadings(const LandingSite& site, double straight_rad) {
  std::bitset<kApproachHeadings> blocked;
  blocked.set();
  for (int k = 0; k < kApproachHeadings; ++k) {
    const double heading_rad = ApproachHeading(k);
    for (int sector = 0; sector < kApproachSectors; ++sector) {
      const double off_rad = std::abs(WrapAngle(HeadingFromSector(sector) - heading_rad));
      if ((site.clear_approaches >> sector & 1U) != 0 && off_rad <= kHalfSector_rad + 1e-9) {
        blocked.reset(static_cast<std::size_t>(k));
      }
    }
  }
  if (const auto nearest = NearestHeading(straight_rad); site.corridor_clear && nearest) {
    blocked.reset(*nearest);
  }
  return blocked;
}

ApproachCourse ChooseCourse(const LandingSite& site, double straight_rad,
                            const HeadingCurve& curve) {
  const ApproachCourse straight{straight_rad, kStraightApproach};
  // Of two that have too much tailwind the better one is flown: a limit for information.
  const auto worth = [&](const ApproachCourse& course) {
    const HeadingScore& score = curve.At(course.heading_rad);
    return score.combined - (score.is_downwind ? 1 : 0);
  };
  const auto turn_rad = [&](const ApproachCourse& course) {
    return std::abs(WrapAngle(course.heading_rad - straight_rad));
  };
  const ApproachCourse* best = nullptr;
  const std::vector<ApproachCourse> clear = ClearCourses(site, straight_rad, false);
  for (const ApproachCourse& course : clear) {
    const double gain = best != nullptr ? worth(course) - worth(*best) : 1;
    if (gain > kEqualScores || (gain > -kEqualScores && turn_rad(course) < turn_rad(*best))) {
      best = &course;
    }
  }
  if (best == nullptr) {
    return straight;
  }
  const bool may_stay = site.corridor_clear && std::isfinite(straight_rad);
  return may_stay && worth(*best) <= worth(straight) + kWorthTurning ? straight : *best;
}

}  // namespace palace
