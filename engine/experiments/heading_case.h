// One case of `evaluate heading`: wind, sun, wanted heading and obstacles; the course that is
// chosen, and what a slow reference (heading_reference.h) and the limits say of it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/flight/approach_heading.h"

namespace palace {

/// Why a course was chosen. Downwind: more tailwind than the limit.
inline constexpr const char* kCourseStraight = "straight";
inline constexpr const char* kCourseRound = "straight is blocked";
inline constexpr const char* kCourseOutOfWind = "straight is downwind";
inline constexpr const char* kCourseBetter = "a side suits better";
inline constexpr const char* kCourseOverAnyway = "all clear are downwind";
inline constexpr const char* kCourseRefused = "nothing clear: refused";
inline constexpr std::array kCourseReasons = {kCourseStraight, kCourseRound,      kCourseOutOfWind,
                                              kCourseBetter,   kCourseOverAnyway, kCourseRefused};

/// Of the wind's speed: how much the tailwind of a course may differ from that of the nearest of 72
/// courses, by which it is judged.
inline const double kTailwindOfNearest = 2 * std::sin(Rad(360.0 / kApproachHeadings / 4));

struct HeadingCase {
  std::string name;  ///< kDrawnCase, or of the reference's list
  HeadingConditions conditions;
  std::string clear;  ///< courses: "straight N SE", by where they come from
  double heading_rad = 0;
  std::string side;
  std::string reason;
  double tailwind_mps = NAN;
  /// Above the limit; NaN where no clear course keeps it.
  double over_limit_mps = NAN;
  bool flies_blocked = false;  ///< though something was clear, or the curve's best is vetoed
  double curve_error = NAN;    ///< largest, of all scores of the 72, from the reference
  bool agrees = false;         ///< the reference leads to that course, or the list has it
};
inline constexpr const char* kDrawnCase = "drawn";

HeadingCase DrawnHeadingCase(std::uint64_t seed, double max_tailwind_mps);
/// The seven of simulation.md 3.3, the best of 72 from a present heading of north.
std::vector<HeadingCase> ListedHeadingCases();

}  // namespace palace
