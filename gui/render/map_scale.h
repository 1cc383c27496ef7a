// What the colours of the maps span: from nothing to so many limits. The pictures are coloured and
// the bars beside them are lettered by the same numbers.
#pragma once

namespace palace {

inline constexpr double kSlopeLimitsShown = 2;
inline constexpr double kRoughnessLimitsShown = 2.5;
inline constexpr double kClearRadiiShown = 2.5;

}  // namespace palace
