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

class Stopwatch {
 public:
  /// The time since the last lap, under this name.
  StageTime Lap(const char* stage) {
    const double now = MonotonicSeconds();
    const StageTime time{stage, (now - last_) * 1e3};
    last_ = now;
    return time;
  }
  /// The same, added to the entry of that name.
  void LapInto(std::vector<StageTime>& times, const char* stage) {
    const StageTime lap = Lap(stage);
    for (StageTime& time : times) {
      if (time.stage == lap.stage) {
        time.milliseconds += lap.milliseconds;
        return;
      }
    }
    times.push_back(lap);
  }

 private:
  double last_ = MonotonicSeconds();
};

}  // namespace palace
