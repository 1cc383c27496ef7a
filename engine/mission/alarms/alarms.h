// Alarms: what the operator must know. A table: one row an alarm, with the limit that raises it,
// and its words. The condition and the sentence are handed the same limit, so that
// no text can name another one.
//
// Source: reference/station-gui.md 3.2, look.md 10.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "engine/mission/alarms/alarm_board.h"
#include "engine/mission/limits.h"
#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"
#include "engine/mission/watch/loss_watch.h"
#include "engine/model/mission/limit_row.h"

namespace palace {

/// What the alarms look at, for one step. NaN where nothing is known.
struct AlarmFacts {
  bool has_source = false;
  bool has_vehicle = false;
  bool pictures_only = false;
  bool heard_vehicle = false;
  bool recorder_ok = true;
  std::string unusual_settings{};
  RecordState record{};
  std::string engine_stop{};
  std::string source_damage{};

  double left_camera_age_s = NAN, right_camera_age_s = NAN;
  double pose_age_s = NAN, link_age_s = NAN;
  double pair_age_s = NAN;  ///< since pictures of both cameras belonged together
  bool clock_stepped = false, rebooted = false;
  double clock_step_s = NAN;        ///< the last one
  double since_clock_step_s = NAN;  ///< NaN: there was none
  double stalled_s = NAN;           ///< this machine, lately; NaN: it was not
  double attitude_invalid_s = NAN;  ///< vehicle poses are refused for their numbers, for so long
  double invalid_for_s = NAN;       ///< the same; 0 while they are used
  double silence_s = NAN;           ///< since anything came from the vehicle
  double lost_percent = NAN;        ///< of the samples of the last 5 s: LostShare
  std::string losers{};             ///< LosersWords
  double ground_age_s = NAN;        ///< of the site's, in a descent above the commit height
  double gps_error_m = NAN;         ///< 3 sigma, horizontal
  double gps_age_s = NAN;
  GpsAgreement gps_agreement{};
  GravityAgreement gravity{};
  double tilt_deg = NAN;  ///< as measured
  LaserHealth laser{};
  double energy_min =
      NAN;  ///< that fuel or battery last; NaN: not known, or it stands on the ground
  double energy_reserve_min = NAN;  ///< setting
  double energy_percent = NAN;      ///< likewise
  double image_time_ms = NAN;       ///< off by so much; NaN while it is not
  double image_offset_ms = NAN;     ///< as measured, of the camera that is off by more
  std::string image_time{};         ///< words for it
  bool on_vision = false;
  PictureFaults pictures{};
  double row_error_px = NAN;
  double exposure_ratio = NAN;       ///< right over left brightness
  double exposure_factor = NAN;      ///< how many times as bright the brighter one is
  double scale_error_percent = NAN;  ///< stereo against laser
  bool reads_far = false;
  double laser_mismatch_m = NAN;

  MissionState state = MissionState::kNoLive;
  bool approve_ahead = true;  ///< nothing is approved yet
  std::string letter = "?";
  std::string why{};       ///< the state was entered
  bool committed = false;  ///< descends below the commit height: maps and pictures may end
  WaveOffReport wave_off;
  std::string alternative{};  ///< words for it when the site is lost
  bool site_degraded = false;
  std::string site_reason{};
  bool no_site = false;
  bool not_on_site = false;  ///< it says that it is on the ground, elsewhere
  std::string no_site_reason{};
  double vision_outage_s = NAN;       ///< of a descent on vision
  double max_vision_outage_s = NAN;   ///< setting
  double unconfirmed_height_m = NAN;  ///< above a site that is approved and not confirmed yet
  bool tracked = false;
  double coherence = NAN;
  double min_coherence = NAN;    ///< setting
  std::string trackers_apart{};  ///< why those of the site are not trusted; empty: they are
  double waiting_s = NAN;        ///< for the answer to an approval
  std::string refusal{};
  bool foreign_descent = false;
  ForeignTraffic foreign{};  ///< commands on the bus that this station did not send
  std::string view_only{};   ///< which other station commands
  // Figures of the descent that an alarm guards now; NaN while none does.
  double off_path_m = NAN;
  double off_centre_m = NAN;
  double nav_error_m = NAN;  ///< setting
  double beside_m = NAN;  ///< off the site's centre, once lower than DescentLimits::last_height_m
  double most_beside_m = NAN;
  double descent_rate_mps = NAN;
  double max_descent_rate_mps = NAN;
  double residual_sigma = NAN;
  double max_residual_sigma = NAN;  ///< of the position filter
  double wind_mps = NAN;
  double max_wind_mps = NAN;  ///< setting
  double tailwind_mps =
      NAN;  ///< of the approach that is selected or flown, above the commit height
  double max_tailwind_mps = NAN;  ///< setting
  RecentLosses losses{};
  double refused_hz = NAN;    ///< datagrams
  double bus_load = NAN;      ///< of the busiest channel, in times of what it needs
  double looked_at_hz = NAN;  ///< stereo pairs, while some are replaced by newer ones
};
AlarmFacts AlarmFactsAt(const MissionMemory& memory, const MissionInputs& inputs);
/// Of these, what a descent can hold by: ages, the ground's and the pictures' time.
AlarmFacts HoldFactsAt(const MissionMemory& memory, Timestamp now);

/// The figure by which a row's `stop` holds a descent, and the limit beyond which it does: a row of
/// "Limits in force".
struct HoldLimit {
  LimitId id = LimitId::kLeftCameraAge;
  const char* label = nullptr;  ///< null: it holds by no figure
  double AlarmFacts::*value = nullptr;
  double limit = NAN;
  double AlarmFacts::*limit_from = nullptr;  ///< where the limit is a setting
  const char* unit = "s";
  int decimals = 1;
  const char* lasts = "";  ///< LimitRow
  bool committed = false;  ///< also below the commit height
};

struct AlarmRow {
  AlarmId id;
  AlarmLevel level;
  bool of_mission = false;  ///< about the mission's state: a record is asked for that, not seen
  bool immediate = false;
  Limit limit{};                             ///< that raises it; none: NaN
  double AlarmFacts::*limit_from = nullptr;  ///< where the limit is a setting
  double AlarmFacts::*value = nullptr;       ///< what is held against it
  bool less_is_worse = false;                ///< of the value; the limit is a least one
  /// Where no limit raises it: how bad it is. What is over is told in the words of its worst.
  double (*badness)(const AlarmFacts& f) = nullptr;
  bool (*present)(const AlarmFacts& f, double limit) = nullptr;
  /// What, number, limit, then what to do.
  std::string (*text)(const AlarmFacts& f, const std::string& limit) = nullptr;
  /// A caution that has become a warning; null: never.
  bool (*grave)(const AlarmFacts& f) = nullptr;
  /// Why it ends a selection or an approval now, and holds a descent above the commit height;
  /// empty: it does not, or not yet. Null: it never does. What the text announces is what this
  /// does.
  std::string (*stop)(const AlarmFacts& f) = nullptr;
  HoldLimit hold{};
};
/// Those of a bus: what is refused, too much, of another version, of a second sender.
inline constexpr std::size_t kBusAlarmCount = 6;
std::span<const AlarmRow, kBusAlarmCount> BusAlarms();
/// All of them, in the order of AlarmId.
std::span<const AlarmRow> AlarmTable();
/// The first stop of the table; empty: nothing stops. A vehicle of which nothing is heard is named
/// so and not by the input that is missed first.
std::string WhyStopped(const AlarmFacts& facts);
Limit LimitOf(const AlarmRow& row, const AlarmFacts& facts);

/// What a descent holds by now, in the order of the table, then the height by which the site must
/// be confirmed. Beside it the site's own limits hold (SiteLimits). Rows only from APPROVED to
/// HOLD.
std::vector<LimitRow> LimitsOfHolds(const AlarmFacts& facts);

/// Each alarm's condition, in the order of the table.
std::vector<AlarmCondition> EvaluateAlarms(const AlarmFacts& facts);

}  // namespace palace
