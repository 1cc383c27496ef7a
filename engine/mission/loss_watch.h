// LossWatch: which losses are an alarm.
//
// Losses grow since the session began; an alarm is what came in the last ten seconds. Pictures are
// replaced by newer ones whenever a pass takes longer than a frame, by design: that matters when
// fewer than five pairs a second are left to look at, half of what maps and tracking are made for.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/mission/alarms.h"
#include "engine/model/losses.h"

namespace palace {

class LossWatch {
 public:
  static constexpr double kWindow_s = 10;
  static constexpr double kLeastPairs_hz = 5;

  /// Once a bundle. `pair`: the bundle has pictures.
  void Update(const Losses& losses, bool pair, Timestamp now);
  /// Always the same ids. `vehicle`: there is one, so that late pictures matter.
  std::vector<AlarmCondition> Alarms(bool vehicle) const;

 private:
  struct Sample {
    Timestamp time;
    std::uint64_t pairs = 0;  ///< looked at
    std::uint64_t replaced = 0;
    std::uint64_t undecodable = 0;
    std::uint64_t unrecorded = 0;
    std::uint64_t unsent = 0;
  };
  std::deque<Sample> samples_;  ///< of the window, oldest first; the first is what counts from
  std::string channels_;        ///< that carried what could not be read
};

}  // namespace palace
