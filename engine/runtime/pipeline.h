// Pipeline: one bundle in, one snapshot out. The whole engine as a plain function with memory:
// no threads, no clocks, no files, so that a log replays to the bit.
//
//   rectify -> disparity -> range map -> fuse elevation -> hazard maps -> cost -> safe distance ->
//   sites -> track -> monocular position -> filter -> mission state
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/camera/rectification.h"
#include "engine/mission/mission.h"
#include "engine/model/mission/session_role.h"
#include "engine/model/snapshot.h"
#include "engine/navigation/image_time_watch.h"
#include "engine/navigation/laser_watch.h"
#include "engine/navigation/navigator.h"
#include "engine/navigation/rate_attitude.h"
#include "engine/runtime/channel_monitor.h"
#include "engine/runtime/flight_history.h"
#include "engine/runtime/recorded_mission.h"
#include "engine/runtime/redecisions.h"
#include "engine/runtime/settings_state.h"
#include "engine/runtime/setup_changes.h"
#include "engine/slad/slad.h"
#include "engine/stereo/frozen_check.h"
#include "engine/stereo/range_check.h"
#include "engine/stereo/stereo.h"
#include "engine/tracking/site_tracker.h"

namespace palace {

/// Facts about the session that only the outside knows.
struct SessionStatus {
  SourceStatus source;
  Losses losses;
  bool can_transmit = false;
  AuthorityStatus authority;
  bool recording = false;
  bool recorder_ok = true;  ///< recording as asked, or not asked to record
  std::string recording_path;
  RecordState record;
  std::string engine_stop;  ///< what stopped the engine a moment ago, while it is news
};

struct PipelineOutput {
  std::shared_ptr<const EngineSnapshot> snapshot;
  std::vector<VehicleMessage> messages;
  std::vector<EngineCommand> commands;  ///< applied in this pass, accepted or not, in order
};

class Pipeline {
 public:
  Pipeline(const Settings& settings, MissionOptions mission);

  /// Replay: judge under these limits; what was recorded is judged beside them.
  void RedecideWith(const Settings& settings, std::vector<std::string> held) {
    settings_.Redecide(settings, std::move(held));
  }

  /// Replay: what the flight decided, for pictures reached by a jump.
  void FollowRecord(std::shared_ptr<const FlightRecord> record) {
    mission_of_record_.Follow(std::move(record));
  }

  /// For a pipeline that takes over from this one.
  MissionOptions MissionToGoOn() const { return mission_.OptionsToGoOn(); }
  /// Of the newest snapshot.
  std::uint64_t sequence() const { return sequence_; }
  /// Takes over from one whose last number was `sequence` and whose last snapshot, if any, `last`:
  /// numbers and events go on, nothing else does.
  void GoOnAfter(std::uint64_t sequence, const EngineSnapshot* last);

  PipelineOutput Process(std::shared_ptr<const FrameBundle> bundle,
                         std::vector<EngineCommand> commands, const SessionStatus& session);
  /// Applies commands while time stands still (paused, ended): re-judges the newest map.
  PipelineOutput Refresh(std::vector<EngineCommand> commands, const SessionStatus& session);

 private:
  struct Pass;  // what one call works on
  /// The last snapshot, to be renewed in parts.
  std::shared_ptr<EngineSnapshot> NextSnapshot() const;
  void StartAfterJump(Timestamp now);
  void ApplyCommands(Pass& pass);
  void ApplySettingCommand(Pass& pass, const EngineCommand& command);
  /// `of_record`: a limit that the recorded flight's own operator moved.
  LimitsApply WhenLimitsApply(bool of_record) const;
  void PrepareRig(Pass& pass);
  void See(Pass& pass);
  /// Laser and image time against the motion of the vehicle.
  void WatchMotion(Pass& pass);
  void WatchImageTime(const Pass& pass);
  void WatchLaserSpot(const RangeMap& range);
  BeamPose BeamAt(Timestamp time) const;
  /// Unit vector in the axes of the rectified left camera.
  Eigen::Vector3d BeamDirection() const;
  double SigmaOfPosition() const;
  std::optional<ViewPose> PoseOfPair(const Pass& pass) const;
  /// Which camera repeats its picture, by the newest pair; `posed`: a pose belongs to it.
  FrozenCameras WhichFrozen(const Pass& pass, bool posed);
  void MeasureRange(Pass& pass);
  void Judge(Pass& pass);
  void Track(Pass& pass);
  Timestamp LastMeasured(const EngineSnapshot& snapshot) const;
  void Decide(Pass& pass);
  /// Judges the newest map under `settings`; after a jump, under the names of the record.
  std::shared_ptr<const TerrainDecision> DecisionUnder(const Settings& settings, Letters letters);
  std::shared_ptr<const std::vector<Event>> EventsAt(Timestamp time);
  /// Of a simulated flight: what begins and ends to act becomes an event.
  void NoteSimulation(const Pass& pass);
  /// What the limits in force say of the site that the flight chose.
  void Review(Pass& pass);
  /// Notes what other limits than the flight's make of the newest map.
  void Redecide(Pass& pass);
  PipelineOutput Publish(Pass& pass);
  MissionInputs::Session MissionSession(const Pass& pass, Timestamp now) const;
  /// After this pass's commands: a command decides alike whether it came with the frame or before
  /// it. After a jump, what the record restored.
  const MissionStatus& MissionInForce() const;
  void ForgetOldRig(Pass& pass);
  double GroundHeight() const;
  /// From the left camera along its axis to the ground; NaN where neither a site nor the laser
  /// tell.
  double DepthOfGround(const RigidTransform& X_WC) const;
  /// The laser's spot in the axes of the rectified left camera, when it is as new as the picture.
  std::optional<Eigen::Vector3d> LaserSpot(const EngineSnapshot& snapshot) const;
  /// The site tracked and flown to; after a jump in a replay the recorded one.
  std::optional<LandingSite> TrackedSite(Timestamp now) const;

  SessionRole role_ = SessionRole::kNone;
  int maps_to_rebuild_ = 0;
  bool from_start_ = true;  ///< of the record, without a jump since
  RecordedMission mission_of_record_;
  MissionStatus restored_;  ///< by the record, where the last jump led
  SettingsState settings_;
  Redecisions redecisions_;
  Mission mission_;
  std::optional<StereoRectifier> rectifier_;
  std::shared_ptr<const StereoRig> rig_;
  std::uint64_t calibration_hash_ = 0;
  std::string rig_problem_;
  StereoMatcher matcher_;
  RangeCheck range_check_;
  FrozenCheck frozen_check_;
  Slad slad_;
  SiteTracker tracker_;
  std::uint64_t tracked_site_ = 0;
  Navigator navigator_;
  int frame_moves_ = 0;  ///< as the newest map knows
  LaserWatch laser_watch_;
  ImageTimeWatch image_time_;
  RateAttitude rate_attitude_;
  ChannelMonitor channels_;
  FlightHistory history_;
  std::vector<std::string> injected_faults_;  ///< of the newest bundle
  SetupChanges setup_changes_;
  std::optional<double> laser_height_m_;  // of the laser's spot in W
  double beam_ground_m_ = NAN;  // height where the laser's beam meets what stereo saw last
  std::uint64_t stereo_frames_ = 0;
  std::uint64_t sequence_ = 0;
  std::shared_ptr<const FrameBundle> last_bundle_;
  std::shared_ptr<const EngineSnapshot> last_;
};

}  // namespace palace
