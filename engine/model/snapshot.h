// EngineSnapshot: the one door out of the engine. If it is on the screen, it came from here.
//
// Four parts, each shared by the snapshots that follow until a pass renews something of it:
//
//   session   the source, the record, the limits in force, what happened, how long stages took
//   sensors   what the vehicle and the cameras said last
//   terrain   ranges, maps, sites
//   flight    state of the mission, tracker, navigation, history
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/shared_value.h"
#include "engine/model/channel.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/landing_site.h"
#include "engine/model/mission/authority_status.h"
#include "engine/model/mission/losses.h"
#include "engine/model/mission/mission_status.h"
#include "engine/model/mission/session_role.h"
#include "engine/model/navigation_status.h"
#include "engine/model/range_map.h"
#include "engine/model/recording.h"
#include "engine/model/settings/settings.h"
#include "engine/model/source_status.h"
#include "engine/model/terrain_decision.h"
#include "engine/model/tracker_set_status.h"

namespace palace {

/// What the limits in force say of the site that the flight chose: the armed one, else the best.
struct SiteReview {
  std::string letter;
  bool kept = false;   ///< a re-check on the newest map holds
  std::string reason;  ///< a sentence with value and limit
};

/// Replay under other limits: the best site of one map, judged by the flight's limits and by the
/// reviewer's. Both are of the same map, so that only the limits can make a difference.
struct RedecidedSample {
  Timestamp time;
  std::string recorded;               ///< letter under the flight's limits, empty: none
  std::string best_site;              ///< letter under the reviewer's, empty: none
  double best_safe_distance_m = NAN;  ///< of the reviewer's; NaN without a site
  bool differs = false;               ///< another place, or a site on one side only
};

/// One sample of the descent history, one a frame.
struct HistorySample {
  Timestamp time;
  MissionState state = MissionState::kNoLive;
  Eigen::Vector3d estimate_p_WB{NAN, NAN, NAN};  ///< the estimate in force
  Eigen::Vector3d estimate_v_WB{NAN, NAN, NAN};
  Eigen::Vector3d estimate_sigma_m{NAN, NAN, NAN};
  Eigen::Vector3d gps_p_WB{NAN, NAN, NAN};
  Eigen::Vector3d truth_p_WB{NAN, NAN, NAN};
  // Heights of the skid centre above the site: the armed one, before that the one proposed.
  Eigen::Vector3d p_WS{NAN, NAN, NAN};  ///< that site, NED; NaN without one
  double height_above_site_m = NAN;     ///< by the estimate in force; NaN without a site
  double gps_height_m = NAN;
  double truth_height_m = NAN;
  double from_site_m = NAN;  ///< horizontal distance of skid centre to site, estimate
  double from_site_gps_m = NAN;
  double from_site_truth_m = NAN;
  bool centre_limited = false;  ///< the distance from the site's centre has its limit now
  double plan_height_m = NAN;
  double descent_rate_mps = NAN;
  double descent_rate_sigma_mps = NAN;
  double laser_m = NAN;  ///< height of the skids above the laser's spot
  Timestamp laser_time;  ///< of that return
  double coherence = NAN;
  double residual_sigma = NAN;
  double glide_deviation_m = NAN;
  std::string best_site;  ///< letter, empty: none
  double best_safe_distance_m = NAN;
  bool new_map = false;     ///< a map came with it: the figures of the best site are of now
  bool rebuilding = false;  ///< replay: the map holds fewer frames than it held in flight
};

struct StageTiming {
  std::string stage;
  double milliseconds = 0;
};

/// When a limit that a person moves comes into force.
enum class LimitsApply : std::uint8_t {
  kAtOnce,       ///< with the next map
  kWhenApplied,  ///< until then it is a preview
  kNotNow,       ///< a preview only: the descent keeps the limits it was approved under
};

/// The session: what is so until somebody changes it. Diagnostics and timings are of one pass.
struct SessionPart {
  SessionRole role = SessionRole::kNone;
  SourceStatus source;
  Losses losses;              ///< of all doors: source, inbox, recorder, link
  bool can_transmit = false;  ///< a VehicleLink exists
  AuthorityStatus authority;  ///< whether this station commands, and who else tries
  bool recording = false;
  std::string recording_path;
  RecordState record;  ///< thinned, stopped, how long it lasts

  Settings settings;           ///< in force
  Settings preview_settings;   ///< equal to settings when nothing is previewed
  Settings recorded_settings;  ///< replay: of the flight itself at this time; else as `settings`
  std::uint64_t settings_hash = 0;
  std::uint64_t preview_hash = 0;
  LimitsApply limits_apply = LimitsApply::kAtOnce;
  bool apply_drops = false;  ///< applying drops the site that is armed, or its approval

  /// What maps need and what has not come, for people, "VEHICLE_POSE"; empty: all of it comes.
  std::string missing_inputs;

  std::shared_ptr<const std::vector<Event>> events;
  /// Simulated or recorded flights: the faults that act now, in words, oldest first.
  std::vector<std::string> injected_faults;
  std::vector<StageTiming> timings;
  Diagnostics diagnostics;
};

/// What was heard and seen last, whichever pass it came with.
struct SensorsPart {
  std::vector<ChannelHealth> channels;
  std::shared_ptr<const StereoRig> rig;
  std::shared_ptr<const StereoFrame> frame;  ///< raw pictures
  std::shared_ptr<const ImageU8> left_rectified;
  std::shared_ptr<const ImageU8> right_rectified;
  std::optional<VehiclePose> pose;
  RigidTransform X_WC;  ///< left camera at exposure, on the estimate in force
  std::optional<VehicleStatus> vehicle;
  std::optional<LaserRange> laser;
  std::optional<Truth> truth;
};

/// What is known of the ground, and where one can land on it.
struct TerrainPart {
  std::shared_ptr<const RangeMap> range;
  StereoQuality stereo_quality;
  RangeAgreement range_agreement;
  std::shared_ptr<const TerrainDecision> applied;  ///< null before the first map
  std::shared_ptr<const TerrainDecision> preview;  ///< set while previewed settings differ
  /// Replay: what the flight decided, when limits moved.
  std::shared_ptr<const TerrainDecision> recorded;
  std::optional<SiteReview> site_review;  ///< empty before the first site
  /// Replay: what the reviewer's limits decided so far, in order of time; kept over jumps, until a
  /// limit moves. Null: nothing was decided again.
  std::shared_ptr<const std::vector<RedecidedSample>> redecided;
  /// Replay: maps still to come after a jump until the map holds as many frames as in flight.
  int maps_to_rebuild = 0;
  /// Why no map is made now though pictures come, for people, "On the ground no map is made";
  /// empty: they are made.
  std::string why_no_map;

  /// What the flight decided: in a replay under other limits not what is applied now.
  const std::shared_ptr<const TerrainDecision>& OfRecord() const {
    return recorded ? recorded : applied;
  }
  /// What a screen shows as decided: the preview while there is one.
  const TerrainDecision* Shown() const { return preview ? preview.get() : applied.get(); }
};

/// Where the mission stands and where the vehicle is.
struct FlightPart {
  MissionStatus mission;
  TrackerStatus tracker;      ///< in force
  TrackerSetStatus trackers;  ///< all of them, side by side
  NavigationStatus navigation;
  std::shared_ptr<const std::vector<HistorySample>> history;
};

struct EngineSnapshot {
  std::uint64_t sequence = 0;  ///< strictly increasing
  Timestamp time;              ///< of the bundle it came from
  /// Live sources: this machine's monotonic second (MonotonicSeconds) at which `time` was now.
  /// NaN where the session's clock is the data's own. For ages on a screen see AgeNow.
  double station_s = NAN;
  /// Of maps, sites, state and estimates: equal flights, equal hashes.
  std::uint64_t decision_hash = 0;

  SharedValue<SessionPart> session;
  SharedValue<SensorsPart> sensors;
  SharedValue<TerrainPart> terrain;
  SharedValue<FlightPart> flight;
};

/// How old something of `moment` (any stamp in the snapshot: of a map, a status, an estimate, an
/// event) is for a person who looks at `monotonic_now_s`. On a live source it goes on growing when
/// nothing more is published; elsewhere time stands with the data. Never below zero.
inline double AgeNow(const EngineSnapshot& snapshot, Timestamp moment, double monotonic_now_s) {
  const double since_s =
      std::isnan(snapshot.station_s) ? 0.0 : std::max(0.0, monotonic_now_s - snapshot.station_s);
  return std::max(0.0, SecondsBetween(moment, snapshot.time)) + since_s;
}

}  // namespace palace
