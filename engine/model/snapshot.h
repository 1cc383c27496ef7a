// EngineSnapshot: the one door out of the engine. If it is on the screen, it came from here.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/model/channel.h"
#include "engine/model/elevation_map.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/landing_site.h"
#include "engine/model/mission/losses.h"
#include "engine/model/mission/mission_status.h"
#include "engine/model/navigation_status.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"
#include "engine/model/source_kind.h"
#include "engine/model/terrain_decision.h"

namespace palace {

/// One camera: what it gave, and what was lost on the way.
struct CameraCounters {
  std::string name;          ///< as its channel is called, "Camera left"
  std::string problem;       ///< why no picture comes and what happens next; empty while they come
  std::uint64_t frames = 0;  ///< taken from the device
  std::uint64_t unpaired = 0;        ///< had no partner of the other camera within the tolerance
  std::uint64_t device_dropped = 0;  ///< missing in the device's own beat, or not decodable
  std::uint64_t reopens = 0;         ///< times the device came back
  double rate_hz = NAN;              ///< measured; NaN before two pictures
  double age_s = NAN;                ///< of the newest picture on a live clock; NaN otherwise
};

/// Where the frames come from, and where in time we are.
struct SourceStatus {
  SourceKind kind = SourceKind::kNone;
  std::string name;  ///< scenario, log file, folder or LCM URL
  bool paused = false;
  bool ended = false;
  double speed = 1;  ///< wanted; 0 as fast as possible
  double speed_reached = 1;
  Timestamp start;
  double position_s = 0;             ///< since start
  std::optional<double> duration_s;  ///< known for logs and folders
  bool can_seek = false;
  std::uint64_t frame_index = 0;
  std::uint64_t frame_count = 0;          ///< 0 unknown
  std::vector<CameraCounters> cameras{};  ///< of kCameras and kVideo
  std::string damage{};  ///< of a log: what could not be read, for people; empty when whole
};

/// What the limits in force say of the site that the flight chose: the armed one, else the best.
struct SiteReview {
  char letter = 0;
  bool kept = false;   ///< a re-check on the newest map holds
  std::string reason;  ///< a sentence with value and limit
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
  double height_above_site_m = NAN;  ///< skid above site by the estimate in force
  double from_site_m = NAN;          ///< horizontal distance of skid centre to site, estimate
  double from_site_gps_m = NAN;
  double from_site_truth_m = NAN;
  double plan_height_m = NAN;
  double descent_rate_mps = NAN;
  double laser_m = NAN;
  double coherence = NAN;
  double residual_sigma = NAN;
  double glide_deviation_m = NAN;
  char best_site = 0;
  double best_safe_distance_m = NAN;
  bool rebuilding = false;  ///< replay: the map holds fewer frames than it held in flight
};

struct StageTiming {
  std::string stage;
  double milliseconds = 0;
};

struct EngineSnapshot {
  std::uint64_t sequence = 0;  ///< strictly increasing
  Timestamp time;              ///< of the bundle it came from
  SourceStatus source;
  bool can_transmit = false;  ///< a VehicleLink exists
  bool recording = false;
  std::string recording_path;
  double recording_minutes_left = 0;
  std::vector<ChannelHealth> channels;
  Losses losses;  ///< of all doors: source, inbox, recorder, link

  std::shared_ptr<const StereoRig> rig;
  std::shared_ptr<const StereoFrame> frame;  ///< raw pictures
  std::shared_ptr<const ImageU8> left_rectified;
  std::shared_ptr<const ImageU8> right_rectified;
  std::shared_ptr<const RangeMap> range;
  StereoQuality stereo_quality;
  RangeAgreement range_agreement;

  std::shared_ptr<const TerrainDecision> applied;  ///< null before the first map
  std::shared_ptr<const TerrainDecision> preview;  ///< set while previewed settings differ
  std::shared_ptr<const TerrainDecision>
      recorded;  ///< replay: what the flight decided, when limits moved

  std::optional<SiteReview> site_review;  ///< empty before the first site

  /// Replay: maps still to come after a jump until the map holds as many frames as in flight.
  int maps_to_rebuild = 0;

  MissionStatus mission;
  TrackerStatus tracker;
  NavigationStatus navigation;
  std::optional<VehiclePose> pose;
  RigidTransform X_WC;  ///< left camera at exposure, on the estimate in force
  std::optional<VehicleStatus> vehicle;
  std::optional<LaserRange> laser;
  std::optional<Truth> truth;

  Settings settings;          ///< in force
  Settings preview_settings;  ///< equal to settings when nothing is previewed
  std::uint64_t settings_hash = 0;
  std::uint64_t preview_hash = 0;

  std::shared_ptr<const std::vector<Event>> events;
  std::shared_ptr<const std::vector<HistorySample>> history;
  std::vector<StageTiming> timings;
  Diagnostics diagnostics;
  std::uint64_t decision_hash =
      0;  ///< of maps, sites, state and estimates: equal flights, equal hashes
};

}  // namespace palace
