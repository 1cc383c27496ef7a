// Figures as people read them beside a limit.
#pragma once

#include <cmath>

namespace palace {

/// The next tenth below: what misses a least limit is never told as that limit. For a greatest
/// limit: -TenthsDown(-value).
inline double TenthsDown(double value) { return std::floor(value * 10) / 10; }

}  // namespace palace
