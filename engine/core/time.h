// Data time. Every stamp is int64 microseconds of the data's own clock (LCM's `utime`).
//
// Stamps come from outside: differences and sums saturate at the ends of the range instead of
// wrapping, so that a stamp of -2^63 or 2^63 - 1 is very far away and nothing worse.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace palace {

/// A moment in data time. Ages are differences of two stamps of the same clock.
struct Timestamp {
  std::int64_t us = 0;
  friend auto operator<=>(const Timestamp&, const Timestamp&) = default;
};

/// a - b and a + b, held at the ends of the range.
inline std::int64_t SaturatedDifference(std::int64_t a, std::int64_t b) {
  using Range = std::numeric_limits<std::int64_t>;
  std::int64_t difference = 0;
  return !__builtin_sub_overflow(a, b, &difference) ? difference
         : a < b                                    ? Range::min()
                                                    : Range::max();
}
inline std::int64_t SaturatedSum(std::int64_t a, std::int64_t b) {
  using Range = std::numeric_limits<std::int64_t>;
  std::int64_t sum = 0;
  return !__builtin_add_overflow(a, b, &sum) ? sum : b < 0 ? Range::min() : Range::max();
}
/// To the nearest microsecond, held at the ends of the range; 0 for NaN.
inline std::int64_t Microseconds(double seconds) {
  using Range = std::numeric_limits<std::int64_t>;
  const double us = seconds * 1e6 + (seconds < 0 ? -0.5 : 0.5);
  constexpr double kEnd = 9223372036854775808.0;  // 2^63
  return us >= kEnd    ? Range::max()
         : us <= -kEnd ? Range::min()
         : us == us    ? static_cast<std::int64_t>(us)
                       : 0;
}

inline double SecondsBetween(Timestamp from, Timestamp to) {
  return static_cast<double>(SaturatedDifference(to.us, from.us)) * 1e-6;
}
inline Timestamp AddSeconds(Timestamp t, double seconds) {
  return {SaturatedSum(t.us, Microseconds(seconds))};
}

/// Wall clock in microseconds since the Unix epoch; for file names and live sources only.
Timestamp WallTime();
/// Monotonic seconds, for measuring durations only.
double MonotonicSeconds();

}  // namespace palace
