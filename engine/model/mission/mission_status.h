// Mission state as the engine publishes it: states, guards, alarms, events.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/model/approach_side.h"
#include "engine/model/landing_site.h"
#include "engine/model/mission/energy_left.h"
#include "engine/model/mission/fly_area.h"
#include "engine/model/mission/heading_curve.h"
#include "engine/model/mission/limit_row.h"
#include "engine/model/mission/mission_ids.h"
#include "engine/model/mission/seen_ground.h"
#include "engine/model/vehicle_message.h"

namespace palace {

enum class MissionState : std::uint8_t {
  kNoLive,
  kSearch,
  kProposed,
  kArmed,
  kApproved,
  kDescending,
  kHold,
  kAborting,
  kLanded,
};
/// Upper-case name as logs and scripts use it: "PROPOSED".
const char* MissionStateName(MissionState state);
/// Sentence-case word as the screen shows it: "Proposed".
const char* MissionStateWord(MissionState state);
/// An approval is out: APPROVED or DESCENDING.
constexpr bool IsFlying(MissionState state) {
  return state == MissionState::kApproved || state == MissionState::kDescending;
}

/// One check of the commit guards G1-G15 (reference: safety state machine).
struct GuardResult {
  GuardId id = GuardId::kLink;
  std::string name;  ///< "Both cameras fresh"
  bool pass = false;
  std::string reason;  ///< when it fails: what, since when, limit ("Left camera stale, 1.8 s")
};

enum class AlarmLevel : std::uint8_t { kAdvisory, kCaution, kWarning };
struct Alarm {
  AlarmId kind = AlarmId::kCameraLeft;
  AlarmLevel level = AlarmLevel::kAdvisory;
  std::string text{};  ///< what, number, limit, then what to do
  Timestamp since{};
  int count = 1;
  bool acknowledged = false;
  bool active = true;                ///< false: cleared but not acknowledged
  std::string id = AlarmName(kind);  ///< as the wire and AcknowledgeAlarm spell it: "gps_error"
  /// The worst that its figure was while it was told, with the unit: "0.62 m"; empty: it has none.
  std::string worst{};
};

enum class EventKind : std::uint8_t {
  kState,
  kSite,
  kDecision,
  kSetting,
  kAlarm,
  kBookmark,
  kVehicle,
  kFault,  ///< of a simulated flight: one was injected, or ended
};
struct Event {
  Timestamp time;
  EventKind kind = EventKind::kState;
  std::string text;
  std::uint64_t number =
      0;  ///< rises in a flight, over a restart of the engine too; 0: not counted
  /// Of an alarm that rose; empty: of something else, or nobody told.
  std::optional<AlarmLevel> level{};
};

/// Between what was asked for and why it was refused: "Select refused: No site is proposed".
inline constexpr const char* kRefusedMark = " refused: ";
/// The event tells of a command that the station refused.
bool IsRefusal(const Event& event);

/// What an event of a fault begins with; the fault in words follows: "GPS jump 3 m".
inline constexpr const char* kFaultBegan = "Fault injected: ";
inline constexpr const char* kFaultEnded = "Fault ended: ";
/// Faults in words that were injected and have not ended, oldest first.
std::vector<std::string> ActingFaults(const std::vector<Event>& events);

/// What the last maps together say of the approved site.
enum class SiteVerdict : std::uint8_t {
  kHolds,
  kDegraded,  ///< inside the limits, but not surely, or with less room or older than it should be
  kLost,
};
/// Word of the screen: "Holds".
const char* SiteVerdictWord(SiteVerdict verdict);

/// One re-check of the approved site during descent.
struct SiteRecheck {
  Timestamp time;
  double height_above_site_m = 0;
  double safe_distance_m = 0;
  bool holds = true;   ///< on this map alone
  std::string reason;  ///< why it is degraded or lost, with value and limit; empty when it holds
  SiteVerdict verdict = SiteVerdict::kHolds;  ///< over the last maps, with hysteresis
  /// The best other site that shares no ground with this one, of the same map; `reason` says why
  /// it is kept. Offered when this one is lost, never flown to unasked.
  std::optional<LandingSite> alternative{};
};

/// How the site is approached: the same on the button, in the approval and in the vehicle.
struct ApproachPlan {
  double heading_rad = NAN;       ///< course over ground, from north over east
  double glide_slope_rad = NAN;   ///< down from the horizon
  double descent_rate_mps = NAN;  ///< down the slope, the vertical part
  int side = kStraightApproach;   ///< that it comes from (approach_side.h)
  std::string why{};              ///< of a side that the station chose: "into the wind"

  /// Round to another side, not straight from where the vehicle is.
  bool turned() const { return side != kStraightApproach; }
};

/// Where the vehicle is on the path that was approved; NaN and empty while it does not fly it.
struct PathProgress {
  double plan_height_m = NAN;  ///< of the skids above the site, at the nearest point of the path
  double off_path_m = NAN;     ///< distance from there
  struct Height {
    double in_s = 0;
    double height_m = 0;
  };
  std::vector<Height> ahead;  ///< planned, from now on, until the touchdown or for a minute
};

/// The way to another hover that the vehicle was sent on (mission/going.h).
struct Going {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< where it ends
  double heading_rad = 0;                          ///< and what it looks at from there
  Timestamp since;
  double to_go_m = 0;
  double unseen_m = 0;    ///< of the way at its start, over ground that no map showed
  bool accepted = false;  ///< by the vehicle's word or deed
  bool flown = false;     ///< it says so
};

/// Where the station would have the vehicle look next (mission/searching.h). Nothing is sent before
/// the operator says so.
struct ProposedLook {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  double heading_rad = 0;
  std::string words;  ///< after "Look": "right 45°", "up 3 m", "12 m N"
  std::string why;    ///< as a clause: "shows 240 of 2400 m² left to see, in 14 s"
};

/// What became of the newest wave-off, by what the vehicle said after it.
struct WaveOffReport {
  enum class Phase : std::uint8_t {
    kNone,        ///< none under way
    kSent,        ///< the vehicle was not heard since
    kUnanswered,  ///< the same, for longer than an answer takes
    kAccepted,    ///< it answered
    kFlies,       ///< it says that it flies it; from its hover there may be nothing to climb
    kClimbs,      ///< and that it rises
    kDone,        ///< it says that it hovers again
    kStands,      ///< it says that it stands on the ground
  };
  Phase phase = Phase::kNone;
  double age_s = NAN;  ///< of the word that says so; before any, how long it is waited for
  bool over = false;   ///< acknowledging it searches again
};

struct MissionStatus {
  MissionState state = MissionState::kNoLive;
  Timestamp since;
  std::string why;                       ///< cause of the last transition, in words
  std::optional<LandingSite> armed;      ///< frozen evidence, from ARMED to LANDED
  std::vector<LimitRow> armed_limits;    ///< of `armed`, under the limits that it was armed under
  std::optional<LandingSite> armed_now;  ///< the same place on the newest map; empty off it
  SiteVerdict armed_verdict = SiteVerdict::kHolds;  ///< what the last maps together say of it
  std::string armed_why;                            ///< with value and limit; empty while it holds
  bool armed_confirmed = false;                     ///< when it was selected, or by a map since
  /// Of the armed site: frozen with it, as soon as the vehicle's place is known, but for a person
  /// who turns it.
  std::optional<ApproachPlan> approach;
  /// ARMED: the sides that TurnApproach takes, clockwise by where they come from. The planned one
  /// is missing where it is not clear any more.
  std::vector<int> approach_sides;
  /// ARMED: what speaks for each course to the site now; empty in other states.
  std::optional<HeadingCurve> headings;
  Timestamp armed_at;
  std::optional<Timestamp> arm_expires;
  /// Ids of places the operator refused: listed, but never proposed again while their letters live.
  std::vector<std::uint64_t> refused_sites;
  bool IsRefused(std::uint64_t site_id) const;
  /// The first of `sites`, best first, that is not refused; null when there is none.
  const LandingSite* BestStanding(const std::vector<LandingSite>& sites) const;
  /// The state is one in which that site can be selected: any that is proposed; while searching
  /// only a refused one, for a second look. Never one without a letter of the flight.
  bool TakesSelection(std::uint64_t site_id) const;
  bool may_select = false;  ///< a person may select in this session (session_role.h)
  /// That person may select that site now.
  bool MaySelect(std::uint64_t site_id) const { return may_select && TakesSelection(site_id); }
  std::vector<GuardResult> guards;  ///< for the armed site
  bool can_approve = false;
  std::string cannot_approve_reason;  ///< first guard that fails, of any site where none is armed
  std::optional<Approval> approval;
  /// What was approved of the armed site is a look that ends so high above it, also when it is
  /// over; 0: a landing, or nothing was.
  double stop_height_m = 0;
  bool IsLook() const { return stop_height_m > 0; }
  /// LandingSite::look_height_m of the armed site as the last map told it that told one: when it
  /// was selected or since. NaN: none did.
  double look_from_m = NAN;
  /// A look would settle what is not sure about the armed site, and it is known from where.
  bool OffersLook() const;
  std::string approved_by;  ///< "the operator" or "a script"; empty where nobody tells
  enum class ApprovalPhase : std::uint8_t { kNone, kSent, kAccepted, kRefused };
  ApprovalPhase approval_phase = ApprovalPhase::kNone;
  std::optional<Going> going;  ///< the vehicle was sent to another hover, and is not there yet
  std::string why_not_go;      ///< why it is not sent anywhere now; empty: it may be
  /// Nothing is selected: the look that promises most. ARMED: the one without which the site cannot
  /// be approved. Empty: there is none.
  std::optional<ProposedLook> next_look;
  std::string why_no_look;  ///< "All ground within 60 m was looked at"; empty with one
  std::shared_ptr<const SeenGround> seen;  ///< what was looked at; null: nothing yet
  std::optional<FlyArea> area;             ///< that the operator drew; empty: none
  EnergyLeft energy;
  /// SEARCH, PROPOSED: why the site selected last is not, or was not reached, what a look at it
  /// found, or how a way to another hover ended.
  std::string selection_ended;
  std::string search_stopped;  ///< SEARCH: what keeps every site from a proposal; empty: nothing
  WaveOffReport wave_off;
  std::string why_no_wave_off;   ///< "Vehicle on the ground"; empty: it is offered
  std::string approval_answer;   ///< the vehicle's reason when refused
  double approval_answer_s = 0;  ///< time the vehicle took to answer; while SENT, waits so far
  std::vector<SiteRecheck> rechecks;
  std::vector<Alarm> alarms;  ///< those that stand first; among them, worst first
  int alarms_in_record = 0;   ///< that stood now in the recorded flight, judged again or not
  Eigen::Vector3d site_p_WS{NAN, NAN, NAN};  ///< the next two are of: armed, before that proposed
  double height_above_site_m = 0;            ///< skid above the site; NaN when no site
  double distance_to_site_m = 0;             ///< horizontal; NaN when no site
  double time_to_touchdown_s = 0;            ///< of a look to its hover; NaN when unknown
  PathProgress path;
  /// Of the armed site, in W: B where it is, where the slope begins, and the site, or B where a
  /// look ends. Empty before the approach is planned and where nothing is flown any more.
  std::vector<Eigen::Vector3d> way_W;
  std::vector<LimitRow> limits;   ///< of site, approach, descent and cameras, in force now
  double confirm_height_m = NAN;  ///< a provisional site must be confirmed by here
  /// LANDED: miss of the skid centre to the site, by the estimate.
  std::optional<double> touchdown_miss_m;
  std::optional<double> touchdown_miss_true_m;  ///< in simulation
  std::optional<double> touchdown_sink_mps;     ///< just before it, by the estimate
};

}  // namespace palace
