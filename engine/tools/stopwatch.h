// Times of the stages of a command, for its report.
#pragma once

#include <string>
#include <vector>

#include "engine/core/time.h"

namespace palace {

struct StageTime {
  std::string stage;
  double milliseconds = 0;
};

/// Runs from construction on.
class Stopwatch {
 public:
  /// The time since the last lap belongs to this stage, beside what it had before.
  void Lap(const char* stage) {
    const double now = MonotonicSeconds();
    const double milliseconds = (now - last_) * 1e3;
    last_ = now;
    for (StageTime& time : times_) {
      if (time.stage == stage) {
        time.milliseconds += milliseconds;
        return;
      }
    }
    times_.push_back({stage, milliseconds});
  }
  /// In the order in which the stages came first.
  const std::vector<StageTime>& times() const { return times_; }

 private:
  double last_ = MonotonicSeconds();
  std::vector<StageTime> times_;
};

}  // namespace palace
