// How well each of 72 courses suits an approach (flight/approach_heading.h makes it).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "engine/core/frames.h"
#include "engine/core/units.h"

namespace palace {

inline constexpr int kApproachHeadings = 72;  ///< every 5 degrees from north, clockwise

/// Heading k of the list, in [0, 2 pi).
constexpr double ApproachHeading(int k) { return Rad(360.0 / kApproachHeadings * k); }

struct HeadingScore {
  double heading_rad = 0;
  double wind = 1;
  double sun = 1;
  double orientation = 1;
  double combined = 1;
  double tailwind_mps = NAN;  ///< a headwind is negative; NaN: not known
  bool is_blocked = false;
  bool is_downwind = false;  ///< more tailwind than the limit

  bool IsVetoed() const { return is_blocked || is_downwind; }
};

/// Index of the heading nearest to that angle, whatever its turns; nothing for one that is not
/// known (NaN or infinite).
inline std::optional<std::size_t> NearestHeading(double heading_rad) {
  if (!std::isfinite(heading_rad)) {
    return std::nullopt;
  }
  const double step_rad = Rad(360.0 / kApproachHeadings);
  const long nearest = std::lround(WrapAngle(heading_rad) / step_rad);
  return static_cast<std::size_t>((nearest + kApproachHeadings) % kApproachHeadings);
}

struct HeadingCurve {
  std::array<HeadingScore, kApproachHeadings> headings;
  /// The one without veto of the greatest combined (1 - kTurnPenalty turn / pi), `turn` from the
  /// present heading. Of equals the one that turns least from the wanted heading; of those, and
  /// where none is wanted, the first from north. Nothing: all are vetoed.
  std::optional<int> best;

  /// Of the nearest heading. One that is not known is vetoed.
  const HeadingScore& At(double heading_rad) const {
    static const HeadingScore unknown{.heading_rad = NAN, .combined = 0, .is_blocked = true};
    const std::optional<std::size_t> nearest = NearestHeading(heading_rad);
    return nearest ? headings[*nearest] : unknown;
  }
};

}  // namespace palace
