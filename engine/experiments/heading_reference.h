// A slow, plain scoring of approach headings, to hold flight/approach_heading against: no rule
// base and no shared code, only the sentences of the reference in degrees, and each answer the
// centroid of the greatest of its scaled output triangles, summed over many slices.
//
// Terms of the answer: triangles of half width 0.25 about 0, 0.25, 0.5, 0.75, 1. Over n slices the
// centroid is off by at most about 1 / n^2. Unknown inputs (NaN) score 1 and weigh nothing.
// Source: reference simulation.md 3.2 and 3.3; Mamdani and Assilian 1975.
#pragma once

#include "engine/flight/approach_heading.h"

namespace palace {

struct ReferenceScore {
  double wind = 1;
  double sun = 1;
  double orientation = 1;
  double combined = 1;
};

ReferenceScore ScoreByReference(const HeadingConditions& conditions, double heading_rad);

/// What its curve may be off by; measured 6e-8.
inline constexpr double kReferenceTolerance = 1e-6;

}  // namespace palace
