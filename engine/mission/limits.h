// Numbers that the mission holds things against. Each stands once: the rule that enforces it and
// the sentence that names it both read it here. Limits that a person may move are in Settings.
//
// Source: reference/reliability.md 3.3 (G) and 4 (F), DESIGN.md 6 and 8.
#pragma once

#include <cmath>
#include <string>

#include "engine/model/channel.h"
#include "engine/model/mission/map_age.h"
#include "engine/model/mission/picture_faults.h"
#include "engine/model/mission/wave_off_offer.h"
#include "engine/model/site_standing.h"

namespace palace {

/// Limits of the guards.
struct GuardLimits {
  static constexpr double link_s = kLinkSilent_s;
  static constexpr double pose_s = 0.2;
  static constexpr double camera_s = 0.5;
  static constexpr double map_s = kMapOld_s;
  static constexpr double shown_s = 1.0;        ///< the selected site, on screen
  static constexpr double laser_height_m = 15;  ///< lower, heights without a laser are not enough
  static constexpr double arm_to_approve_s = 0.5;
  static constexpr double lost_percent = 50;                    ///< of the vehicle's messages (F21)
  static constexpr double confirm_height_m = kConfirmHeight_m;  ///< of a provisional site
};

/// An age beyond which a selection, an approval or a descent ends.
struct StaleLimits {
  static constexpr double cameras_live_s = 5;  ///< no mission at all beyond this
  static constexpr double link_s = 5;          ///< F19
  static constexpr double sensor_s = 1;        ///< pose and cameras: F01, F10
  static constexpr double map_s = 3;
  static constexpr double ground_s = 2;  ///< of the site, in the descent above commit height
  static constexpr double invalid_pose_s = 0.5;  ///< F10: for so long what comes is no number
};

/// Beyond these an alarm is raised, where no guard's limit does it.
struct AlarmLimits {
  static constexpr double gps_error_m = 2.0;
  static constexpr double gps_silence_s = 2.0;
  static constexpr double vision_late_s = 0.3;
  static constexpr double answer_s = 2.0;
  static constexpr double lost_percent = 100 * kMostLostShare;  ///< F21
  static constexpr double told_s = 10;  ///< what is over at once is told for so long
  static constexpr double laser_mismatch_m = 1.0;
  static constexpr double row_error_px = kMostRowError_px;
  static constexpr double exposure = 2;         ///< one picture twice as bright as the other
  static constexpr double scale_percent = 2;    ///< 0.3 m of height at 50 ft
  static constexpr double refused_hz = 1;       ///< datagrams: F25
  static constexpr double bus_load = 10;        ///< times what a channel needs: F31
  static constexpr double foreign_s = 10;       ///< a foreign command is told for this long
  static constexpr double energy_percent = 10;  ///< where no rate is known
  static constexpr double least_pairs_hz = 5;   ///< half of what maps and tracking are made for
};

/// A number with its unit, as a sentence names it.
struct Limit {
  double value = NAN;  ///< NaN: there is no number
  const char* unit = "";
  int decimals = 1;
};
/// "0.5 s"; empty when there is no number.
std::string LimitWords(const Limit& limit);

}  // namespace palace
