// What of an approval any vehicle takes: beyond these it refuses, whoever asks.
#pragma once

namespace palace {

struct ApprovalLimits {
  static constexpr double kLongest_s = 120;
  static constexpr double kAhead_s = 1;
  static constexpr double kReach_m = 100;
  static constexpr double kDeepest_m = 100;
  static constexpr double kLeastRadius_m = 0.5;  ///< that is to be clear around the site
  static constexpr double kMostRadius_m = 25;
  static constexpr double kLeastStop_m = 3;
};

}  // namespace palace
