// Guards G1-G15: what must hold at the instant of approval. A table: one row a guard, with the
// limit it holds, its words, and why it fails. What fails blocks approval; nothing else acts on it.
//
// A guard passes only on evidence: NaN ages, missing inputs and unknown hashes fail (I3).
// Source: reference/reliability.md 3.3; G4, G6 and G14 as settled in DESIGN.md 8;
// G15: the wind that the vehicle measures (descent_limits.h).
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "engine/mission/limits.h"
#include "engine/mission/mission_memory.h"
#include "engine/mission/watch/picture_watch.h"
#include "engine/model/mission/mission_status.h"

namespace palace {

/// What the guards look at. Ages in seconds, NaN when never; text says why, empty when fine.
struct GuardInputs {
  double link_age_s = NAN;
  double pose_age_s = NAN;
  double left_camera_age_s = NAN;
  double right_camera_age_s = NAN;
  double pair_age_s = NAN;       ///< since both pictures belonged together
  std::string camera_problem{};  ///< PictureFaults::words
  bool attitude_invalid = false;
  double lost_share = NAN;  ///< of the vehicle's samples; NaN blocks nothing
  std::string losers{};     ///< LosersWords
  double map_age_s = NAN;
  bool position_healthy = false;
  std::string image_time{};  ///< words::ImageTimeOff
  std::string gravity{};     ///< words::GravityOff
  std::string gps{};         ///< words::GpsOff
  LaserHealth laser{};
  double height_m = NAN;  ///< above the armed site
  bool tracker_locked = false;
  std::string why_not_locked{};  ///< of the tracker
  double coherence = NAN;
  double min_coherence = NAN;
  double shown_for_s = NAN;  ///< evidence of the armed site on screen
  bool hashes_unchanged = false;
  std::string lander_problem{};  ///< WhyNotLandable
  std::string site_letter;       ///< empty: nothing is armed
  bool site_holds = false;
  std::string site_reason;
  bool boot_unchanged = false;
  bool clock_continuous = false;
  bool can_transmit = false;
  bool commands = false;  ///< the vehicle granted this station its command
  std::string why_not_commanding;
  bool foreign_approval = false;  ///< the vehicle executes an approval that is not ours
  std::string unacknowledged_warning;
  bool recorder_ok = false;
  bool recorder_loss_acknowledged = false;
  std::string source_reason;  ///< why this source can never be approved on, empty when it can
  double armed_for_s = NAN;
  double arm_window_s = NAN;
  double wind_mps = NAN;  ///< NaN: not known, or stale; then it blocks nothing
  double max_wind_mps = NAN;
};
GuardInputs GuardInputsAt(const MissionMemory& memory, Timestamp now);

struct GuardRow {
  GuardId id;
  const char* words;  ///< what holds when it passes
  /// Speaks of this station's link, recorder or source, or of the weather: a recorded approval met
  /// it in its own time.
  bool of_station = false;
  Limit limit{};                              ///< none: NaN
  double GuardInputs::*limit_from = nullptr;  ///< where the limit is a setting
  /// Why it fails, naming `limit`; empty when it passes.
  std::string (*why)(const GuardInputs& in, const Limit& limit) = nullptr;
};
/// All fifteen, in the order of GuardId.
std::span<const GuardRow> GuardTable();
Limit LimitOf(const GuardRow& row, const GuardInputs& inputs);

std::vector<GuardResult> EvaluateGuards(const GuardInputs& inputs);
/// The first that fails, null when all pass. `as_recorded`: skip those that speak of this station.
const GuardResult* FirstFailure(const std::vector<GuardResult>& guards, bool as_recorded = false);
/// The result of one guard; null in a list that has none of it.
const GuardResult* FindGuard(const std::vector<GuardResult>& guards, GuardId id);

}  // namespace palace
