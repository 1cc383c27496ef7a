// How well each of 72 courses suits an approach by wind, sun and the heading that is wanted.
//
// Three small rule bases (fuzzy.h) give a score each, 0 bad to 1 good; one rule base over all of
// them would meet in the middle where they conflict. They combine to a weighted geometric mean:
//
//   combined = (wind^a sun^b orientation^c)^(1 / (a + b + c)),  b = 1, c = 0.7,
//              a = 0.5 below 3 m/s of wind, 1.5 from 3 to 8 m/s, 3 above
//
// The sun is judged by the angles from the camera's boresight (along the course, depressed) to the
// sun (flare), to the point opposite of it (own shadow) and to its mirror image in level ground
// (glint). Vetoes stand outside of the scores: no score makes up for an obstacle or a tailwind.
//
// What is unknown (NaN, or no finite number) is left out: its score is 1, its exponent 0. So an
// unknown wind vetoes nothing, which the caller has to say. Angles from north over east, courses
// over ground; the scores reach from 0.08 to 0.92, the centroids of the outer terms.
//
// Source: after reference simulation.md 3.2 and 3.3; Mamdani and Assilian 1975. The numbers of the
// rules are judgement, not measured. The reference does not say what its turn penalty counts from.
// We count from the present heading: its listed results come out if that was north.
#pragma once

#include <bitset>
#include <cmath>

#include "engine/core/units.h"
#include "engine/model/mission/heading_curve.h"

namespace palace {

/// Of the combined score, for half a turn from the heading flown now.
inline constexpr double kTurnPenalty = 0.02;
/// Scores that are equal but for rounding.
inline constexpr double kEqualScores = 1e-9;

struct HeadingConditions {
  double wind_mps = NAN;         ///< unknown where negative
  double wind_from_rad = NAN;    ///< where the wind comes from
  double sun_azimuth_rad = NAN;  ///< with the elevation: sun_position.h
  double sun_elevation_rad = NAN;
  double wanted_rad = NAN;          ///< the operator's heading
  double present_rad = NAN;         ///< flown now; unknown: a turn costs nothing
  double depression_rad = Rad(45);  ///< of glide slope and camera below the horizon
  /// 5 knots, a judgement. NaN vetoes every course while the wind is known.
  double max_tailwind_mps = 2.5;
  std::bitset<kApproachHeadings> blocked;  ///< an obstacle stands in the corridor of that course
};

HeadingCurve ScoreHeadings(const HeadingConditions& conditions);

}  // namespace palace
