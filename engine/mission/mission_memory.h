// MissionMemory: all that the mission remembers from one step to the next, and questions to it.
//
// A plain value: copy it, and both copies go on alike. (`MissionState` is the name of the state the
// machine is in, SEARCH or ARMED; this is the whole of what Step takes and gives back.)
// Heights are metres above the site, skid centre. Times are data time of the station.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/mission/alarms/alarm_board.h"
#include "engine/mission/watch/energy_watch.h"
#include "engine/mission/watch/input_watch.h"
#include "engine/mission/watch/loss_watch.h"
#include "engine/mission/watch/picture_watch.h"
#include "engine/mission/watch/site_watch.h"
#include "engine/model/elevation_map.h"
#include "engine/model/mission/authority_status.h"
#include "engine/model/mission/mission_status.h"
#include "engine/model/mission/session_role.h"
#include "engine/model/navigation_status.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"
#include "engine/search/ground_view.h"

namespace palace {

/// Of the last step, for the commands that come before the next: copies, nothing dangles.
struct MissionFacts {
  bool valid = false;
  Timestamp now;
  SessionRole role = SessionRole::kNone;
  std::string why_no_vehicle;
  bool simulated_vehicle = false;
  bool can_transmit = false;
  AuthorityStatus authority;
  bool recorder_ok = false;
  std::vector<LandingSite> sites;
  std::shared_ptr<const ElevationMap> elevation;  ///< that they were found on
  SladSettings site_limits;                       ///< under which they were chosen
  std::uint64_t map_hash = 0;
  std::uint64_t settings_hash = 0;
  std::uint64_t terrain_settings_hash = 0;
  std::uint64_t calibration_hash = 0;
  Settings settings;
  std::string unusual_settings;  ///< OutsideUsual
  NavigationStatus navigation;
  StereoQuality stereo;
  RangeAgreement range_agreement;
  Eigen::Vector3d skid_centre_W = Eigen::Vector3d::Constant(NAN);
  // By the estimate in force; yaw by the vehicle's own attitude.
  Eigen::Vector3d p_WB = Eigen::Vector3d::Constant(NAN);
  Eigen::Vector3d v_WB = Eigen::Vector3d::Constant(NAN);
  double yaw_rad = NAN;
  Eigen::Vector3d p_BC = Eigen::Vector3d::Zero();  ///< left focal point, of the newest rig
  bool position_healthy = false;
  bool tracker_locked = false;
  std::string why_not_locked;  ///< of the tracker
  std::string trackers_apart;  ///< why all trackers together are not trusted; empty: they are
  double coherence = NAN;
};

/// What an armed site is bound to.
struct ArmedFacts {
  std::uint64_t map_hash = 0, settings_hash = 0, terrain_settings_hash = 0;
  std::uint64_t calibration_hash = 0, boot_id = 0;
  std::optional<std::uint64_t> first_sequence;  ///< first snapshot that showed it armed
  Timestamp shown_since;
  bool confirmed = false;
  bool straight_clear = false;  ///< the straight corridor, when it was judged last
  bool course_judged = false;   ///< the planned corridor was, by a map
  /// IsAirShown of a map since: the vehicle's lean decides near the limit, and comes and goes.
  bool air_shown = false;
};

/// What was looked at, and what is worth another look. Kept while the vehicle does not restart.
struct SearchMemory {
  std::optional<GroundView> view;        ///< of the newest rig
  std::optional<LandingSite> promising;  ///< was proposed last
  std::vector<std::uint64_t> looked_at;  ///< promising ones that were flown to, by id
  Timestamp planned_at;
};

/// The best site's run of wins. Once it is long enough for a proposal it goes on whoever leads.
struct WinningRun {
  std::uint64_t site_id = 0;
  int maps = 0;
  Timestamp since;
};

/// A snapshot that was on the screen.
struct ShownSnapshot {
  std::uint64_t sequence = 0;
  Timestamp time;
};

struct MissionMemory {
  MissionMemory();

  MissionStatus status;  ///< as published
  MissionFacts facts;
  ArmedFacts armed;
  SiteWatch site;
  std::optional<LandingSite> newest;       ///< the armed site on the newest map; empty off it
  SiteVerdict told = SiteVerdict::kHolds;  ///< of the armed site, in the events
  /// The best other site now that shares no ground with the armed one.
  std::optional<LandingSite> alternative;
  WinningRun winner;
  SearchMemory search;
  InputWatch watch;
  EnergyWatch energy;
  PictureWatch pictures;
  LossWatch losses;
  AlarmBoard alarms;
  std::deque<ShownSnapshot> shown;  ///< recent ones

  std::uint64_t approvals_given = 0;   ///< the counter that approvals carry (I9)
  std::uint64_t requests_made = 0;     ///< holds, aborts and ways to another hover
  std::uint64_t dead_approval_id = 0;  ///< last approval that may never resume (I14)
  std::uint64_t hold_id = 0, abort_id = 0, go_id = 0;
  std::optional<VehicleMessage> repeating;  ///< until the vehicle answers
  Timestamp sent_at;                        ///< of the message being repeated
  Timestamp approved_at;                    ///< station time of the approval
  std::optional<Timestamp> went_at;         ///< the newest way to another hover ended
  std::string refusal;         ///< the vehicle's refusal of the last approval, empty when none
  std::string vehicle_reason;  ///< why it gave up the approval that it flew, by its own word
  Timestamp foreign_told_at;   ///< newest event about commands of others that it refused
  AuthorityStanding told_standing = AuthorityStanding::kNone;  ///< in the events
  std::uint64_t told_foreign = 0;  ///< foreign messages counted in the newest event about them
  Timestamp told_foreign_at;

  VehicleMode flown_mode = VehicleMode::kUnknown;  ///< the vehicle's newest, heard first at
  Timestamp flown_since;
  bool vehicle_ever_heard = false;
  bool abort_seen = false;      ///< the vehicle's status shows it, or the ground
  Timestamp wave_off_at;        ///< of the newest press
  Timestamp abort_answered_at;  ///< of the newest acceptance of an abort
  bool wave_off_acknowledged = false;
  bool vision_allowed = false;
  Timestamp vision_good_at;
  double sink_mps = NAN;                  ///< by the estimate, while it was last in the air
  std::optional<Timestamp> beside_since;  ///< too far off the site, lower than 1 m
  Timestamp map_seen_at;
  /// The ground of the armed site was measured last; at the earliest when the descent began.
  Timestamp ground_seen_at;
  double lost_share = NAN;  ///< of the vehicle's samples, lately: LostShare
  std::string losers;       ///< LosersWords
};

/// Requests (hold, abort, go) have this bit of their number set, approvals do not.
inline constexpr std::uint64_t kRequestBit = 0x80000000U;

/// A site has won enough maps for long enough, and the maps are new.
bool WinnerStands(const MissionMemory& memory, Timestamp now);
bool SiteLost(const MissionMemory& memory, Timestamp now);
/// The vehicle flies an approval, somebody's.
bool Executing(const MissionMemory& memory);
/// `id` as the vehicle names it is `own`. A record is of another session: there the kind decides.
bool IsSameMessage(const MissionMemory& memory, std::uint64_t id, std::uint64_t own);
bool IsOwnApproval(const MissionMemory& memory, std::uint64_t id);
/// The vehicle flies an approval that is not this station's.
bool FliesForeignApproval(const MissionMemory& memory);
/// Why this station may only look, in a session with a vehicle; null when it may command.
const char* WhyViewOnly(const MissionFacts& facts);
/// A site is armed and watched: ARMED to HOLD.
bool WatchesSite(const MissionMemory& memory);

}  // namespace palace
