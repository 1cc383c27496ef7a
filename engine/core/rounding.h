// Figures as people read them beside a limit.
#pragma once

#include <cmath>

namespace palace {

/// The next tenth below: what misses a least limit is never told as that limit. For a greatest
/// limit: -TenthsDown(-value).
inline double TenthsDown(double value) { return std::floor(value * 10) / 10; }

/// A value that breaks its limit, as it is shown with so many decimals: where rounding would tell
/// it as the limit itself, the next step beyond.
inline double ShownBeyond(double value, double limit, int decimals) {
  const double steps = std::pow(10.0, decimals);
  if (std::round(value * steps) != std::round(limit * steps)) {
    return value;
  }
  return (value < limit ? std::round(limit * steps) - 1 : std::round(limit * steps) + 1) / steps;
}

}  // namespace palace
