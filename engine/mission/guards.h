// Guards G1-G15: what must hold at the instant of approval.
//
// A guard passes only on evidence: NaN ages, missing inputs and unknown hashes fail (I3).
// Source: reference/reliability.md 3.3; G4, G6 and G14 as settled in DESIGN.md 8; G15: the wind
// that the vehicle measures (descent_limits.h).
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/mission_status.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Limits of the guards, in seconds.
struct GuardLimits {
  static constexpr double link_s = 1.0;
  static constexpr double pose_s = 0.2;
  static constexpr double camera_s = 0.5;
  static constexpr double map_s = 2.0;
  static constexpr double shown_s = 1.0;  ///< evidence on screen
  static constexpr double arm_to_approve_s = 0.5;
  static constexpr double confirm_height_m = 10;  ///< a provisional site must be confirmed by here
};

/// What the guards look at. Ages in seconds, NaN when never; text says why, empty when fine.
struct GuardInputs {
  double link_age_s = NAN;
  double pose_age_s = NAN;
  double left_camera_age_s = NAN;
  double right_camera_age_s = NAN;
  std::string camera_problem;  ///< what is wrong with the pictures, empty when nothing is
  double map_age_s = NAN;
  bool position_healthy = false;
  bool tracker_locked = false;
  double coherence = NAN;
  double min_coherence = NAN;
  double shown_for_s = NAN;  ///< evidence of the armed site on screen
  bool hashes_unchanged = false;
  char site_letter = '?';
  bool site_holds = false;
  std::string site_reason;
  bool boot_unchanged = false;
  bool clock_continuous = false;
  bool can_transmit = false;
  bool foreign_approval = false;  ///< the vehicle executes an approval that is not ours
  std::string unacknowledged_warning;
  bool recorder_ok = false;
  bool recorder_loss_acknowledged = false;
  std::string source_reason;  ///< why this source can never be approved on, empty when it can
  double armed_for_s = NAN;
  double arm_window_s = NAN;
  double wind_mps = NAN;  ///< NaN: not known, or stale; then it blocks nothing
};

/// Why nothing can be approved on this source; empty unless it has pictures only.
std::string WhyNoVehicle(SourceKind kind);

/// All fifteen, in order.
std::vector<GuardResult> EvaluateGuards(const GuardInputs& inputs);
/// The first that fails, null when all pass. `as_recorded`: skip those that speak of this station's
/// link, recorder and source (G1, G10, G12, G13) and of the weather (G15); a recorded approval met
/// them in its own time.
const GuardResult* FirstFailure(const std::vector<GuardResult>& guards, bool as_recorded = false);

}  // namespace palace
