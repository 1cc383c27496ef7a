// Data time. Every stamp is int64 microseconds of the data's own clock (LCM's `utime`).
#pragma once

#include <compare>
#include <cstdint>

namespace palace {

/// A moment in data time. Ages are differences of two stamps of the same clock.
struct Timestamp {
  std::int64_t us = 0;
  friend auto operator<=>(const Timestamp&, const Timestamp&) = default;
};

inline double SecondsBetween(Timestamp from, Timestamp to) {
  return static_cast<double>(to.us - from.us) * 1e-6;
}
inline Timestamp AddSeconds(Timestamp t, double seconds) {
  return {t.us + static_cast<std::int64_t>(seconds * 1e6 + (seconds < 0 ? -0.5 : 0.5))};
}

/// Wall clock in microseconds since the Unix epoch; for file names and live sources only.
Timestamp WallTime();
/// Monotonic seconds, for measuring durations only.
double MonotonicSeconds();

}  // namespace palace
