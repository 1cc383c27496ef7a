#include "engine/runtime/pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/mission/watch/picture_watch.h"
#include "engine/runtime/decision_hash.h"
#include "engine/runtime/missing_inputs.h"
#include "engine/runtime/pipeline_pass.h"
#include "engine/slad/hazards/explanation.h"
#include "engine/stereo/range_measurement.h"

namespace palace {
namespace {

constexpr double kPoseAge_s = 0.2;  // of the pose to a pair; an older one makes no map

}  // namespace

Pipeline::Pipeline(const Settings& settings, MissionOptions mission)
    : settings_(settings), mission_(std::move(mission)) {}

void Pipeline::GoOnAfter(std::uint64_t sequence, const EngineSnapshot* last) {
  sequence_ = sequence;
  if (last != nullptr && last->terrain->OfRecord()) {
    slad_.GoOnNaming(last->terrain->OfRecord()->selection.named);
  }
  if (last != nullptr && last->session->events) {
    mission_.GoOnAfter(*last->session->events);
  }
}

void Pipeline::StartAfterJump(Timestamp now) {
  slad_.Forget(StartsAnewAfterJump(role_) ? SiteNames::kAnew : SiteNames::kGoOn);
  tracker_.Reset();
  tracked_site_ = 0;
  navigator_.Reset();
  frame_moves_ = 0;
  laser_watch_.Reset();
  image_time_.Reset();
  beam_depth_m_ = NAN;
  channels_.Reset();
  if (FollowsRecord(role_)) {
    role_ = SessionRole::kReplayedAfterJump;
  }
  if (const Settings* settings =
          FollowsRecord(role_) ? mission_of_record_.SettingsAt(now) : nullptr) {
    settings_.RestoreRecorded(*settings);
  }
  std::vector<HistorySample> before = mission_of_record_.HistoryBefore(now);
  maps_to_rebuild_ =
      FollowsRecord(role_) && (!before.empty() || mission_of_record_.BeginsMidFlight())
          ? settings_.recorded().slad.fusion.frames_fused
          : 0;
  history_.Reset(std::move(before));
  laser_height_m_.reset();
  range_check_.Reset();
  frozen_check_.Reset();
  stereo_frames_ = 0;
  last_.reset();
}

PipelineOutput Pipeline::Process(std::shared_ptr<const FrameBundle> bundle,
                                 std::vector<EngineCommand> commands,
                                 const SessionStatus& session) {
  role_ = RoleOf(session.source.kind, !SeenFromStart(role_));
  const bool cut = FollowsRecord(role_) && !last_bundle_ && mission_of_record_.BeginsMidFlight();
  if (bundle->discontinuity || cut) {
    StartAfterJump(bundle->time);
  }
  Pass pass{bundle, std::move(commands), session, NextSnapshot()};
  pass.snapshot->time = bundle->time;
  // A record's monotonic seconds are of another time of the machine.
  pass.snapshot->station_s = bundle->arrival.clock && session.source.kind == SourceKind::kLive
                                 ? bundle->arrival.clock->station_s
                                 : NAN;
  ApplyCommands(pass);
  PrepareRig(pass);
  See(pass);
  pass.Run("stereo", [&] { MeasureRange(pass); });
  pass.Run("slad", [&] { Judge(pass); });
  pass.Must("track", [&] { Track(pass); });
  pass.Must("mission", [&] { Decide(pass); });
  pass.Run("review", [&] { Review(pass); });
  last_bundle_ = std::move(bundle);
  return Publish(pass);
}

PipelineOutput Pipeline::Refresh(std::vector<EngineCommand> commands,
                                 const SessionStatus& session) {
  role_ = RoleOf(session.source.kind, !SeenFromStart(role_));
  Pass pass{last_bundle_, std::move(commands), session, NextSnapshot()};
  ApplyCommands(pass);
  if (pass.settings_moved && slad_.has_map()) {
    pass.Run("slad", [&] { Judge(pass); });
  }
  if (SeenFromStart(role_)) {
    pass.snapshot->flight.Edit().mission = mission_.status();
  }
  pass.Run("review", [&] { Review(pass); });
  return Publish(pass);
}

std::shared_ptr<EngineSnapshot> Pipeline::NextSnapshot() const {
  // What a pass does not renew stays as it was; only what is told of the pass itself starts empty.
  auto next = last_ ? std::make_shared<EngineSnapshot>(*last_) : std::make_shared<EngineSnapshot>();
  next->session.Edit().diagnostics.clear();
  next->session.Edit().timings.clear();
  return next;
}

void Pipeline::PrepareRig(Pass& pass) {
  const auto& rig = pass.bundle->rig;
  if (rig && rig != rig_) {
    const std::uint64_t hash = HashOf(*rig);
    if (!rig_ || hash != calibration_hash_) {
      Result<StereoRectifier> made = StereoRectifier::Make(*rig);
      rig_problem_ = made ? std::string() : made.error().message;
      rectifier_.reset();
      if (made) {
        rectifier_.emplace(std::move(*made));
      }
      calibration_hash_ = hash;
    }
    rig_ = rig;
  }
  pass.snapshot->sensors.Edit().rig = rig_;
  if (!rig_problem_.empty()) {
    pass.Note(DiagnosticLevel::kError, "camera", rig_problem_);
  }
}

void Pipeline::See(Pass& pass) {
  SensorsPart& sensors = pass.snapshot->sensors.Edit();
  const FrameBundle& bundle = *pass.bundle;
  for (const CameraCounters& camera : pass.session.source.cameras) {
    if (!camera.problem.empty()) {
      pass.Note(DiagnosticLevel::kError, "camera", camera.problem);
    }
  }
  channels_.Add(bundle, !HasPicturesOnly(role_));
  navigator_.AddSensors(bundle);
  if (bundle.pose_at_exposure) {
    sensors.pose = bundle.pose_at_exposure;
  } else if (!bundle.poses.empty()) {
    sensors.pose = bundle.poses.back();
  }
  if (bundle.status) {
    sensors.vehicle = bundle.status;
  }
  if (!bundle.laser.empty()) {
    sensors.laser = bundle.laser.back();
  }
  if (!bundle.truth.empty()) {
    sensors.truth = bundle.truth.back();
  }
  WatchMotion(pass);
  if (!bundle.stereo || !rectifier_) {
    return;
  }
  sensors.frame = bundle.stereo;
  sensors.X_WC = navigator_.PredictBodyPose(bundle.stereo->time) * rectifier_->X_BC(*rig_);
  if (const auto spot = LaserSpot(*pass.snapshot)) {
    laser_height_m_ = HeightFromDown((sensors.X_WC * *spot).z());
  }
  pass.Run("rectify", [&] {
    Result<RectifiedPair> pair = rectifier_->Rectify(*bundle.stereo);
    if (!pair) {
      pass.Note(DiagnosticLevel::kError, "camera", pair.error().message);
      return;
    }
    pass.pair = *pair;
    sensors.left_rectified = pair->left;
    sensors.right_rectified = pair->right;
    if (!HasPicturesOnly(role_)) {
      image_time_.AddPictures(pair->left.get(), pair->right.get(), bundle.stereo->time);
    }
  });
}

const MissionStatus& Pipeline::MissionInForce() const {
  return !SeenFromStart(role_) && last_ ? last_->flight->mission : mission_.status();
}

double Pipeline::GroundHeight() const {
  if (const auto& armed = MissionInForce().armed) {
    return HeightFromDown(armed->p_WS.z());
  }
  if (laser_height_m_) {
    return *laser_height_m_;
  }
  return 0;
}

double Pipeline::DepthOfGround(const RigidTransform& X_WC) const {
  const double axis_down = X_WC.R(2, 2);
  const bool known = MissionInForce().armed || laser_height_m_;
  return known && axis_down > 0.1 ? (HeightFromDown(X_WC.p.z()) - GroundHeight()) / axis_down : NAN;
}

std::optional<ViewPose> Pipeline::PoseOfPair(const Pass& pass) const {
  const auto& pose = pass.snapshot->sensors->pose;
  if (!pose || std::abs(SecondsBetween(pose->time, pass.bundle->stereo->time)) > kPoseAge_s) {
    return std::nullopt;
  }
  return ViewPose{pass.snapshot->sensors->X_WC, pose->sigmas};
}

void Pipeline::MeasureRange(Pass& pass) {
  if (!pass.pair.left || !pass.pair.right) {
    return;
  }
  const Settings& settings = settings_.recorded();
  const MissionStatus& mission = MissionInForce();
  const bool committed = mission.state == MissionState::kDescending &&
                         mission.height_above_site_m < settings.slad.fusion.commit_height_m;
  const bool due =
      stereo_frames_++ % static_cast<std::uint64_t>(settings.stereo.map_every_frames) == 0;
  if (committed || !due || mission.state == MissionState::kLanded) {
    return;
  }
  const std::optional<ViewPose> pose = PoseOfPair(pass);
  Result<StereoResult> result = MeasureRanges({.raw = *pass.bundle->stereo,
                                               .pair = pass.pair,
                                               .rig = *rig_,
                                               .rectifier = *rectifier_,
                                               .pose = pose,
                                               .ground_height_m = GroundHeight()},
                                              settings.stereo, matcher_);
  if (!result) {
    pass.Note(DiagnosticLevel::kError, "stereo", result.error().message);
    return;
  }
  const FrozenCameras frozen =
      frozen_check_.Add({.time = pass.bundle->stereo->time,
                         .left = pass.pair.left,
                         .right = pass.pair.right,
                         .X_WC = pass.snapshot->sensors->X_WC,
                         .camera = rectifier_->camera(),
                         .depth_m = pose ? DepthOfGround(pass.snapshot->sensors->X_WC) : NAN});
  result->quality.left_frozen = frozen.left;
  result->quality.right_frozen = frozen.right;
  pass.snapshot->terrain.Edit().stereo_quality = result->quality;
  pass.new_stereo = true;
  if (result->quality.suspect_covered) {
    pass.Note(DiagnosticLevel::kWarning, "stereo",
              "one camera shows nothing while the other does; it may be covered");
  }
  if (result->quality.suspect_same) {
    pass.Note(DiagnosticLevel::kWarning, "stereo",
              "left and right are the same picture; check the capture devices");
  }
  auto range = std::make_shared<const RangeMap>(std::move(result->range));
  pass.snapshot->terrain.Edit().range = range;
  if (!pose) {
    pass.Note(DiagnosticLevel::kWarning, "slad",
              std::string("attitude and height are unknown, so ranges make no map; ") +
                  (HasPicturesOnly(role_) ? "add [pose] to RIG.toml"
                                          : "no VEHICLE_POSE is within 0.2 s of them"));
    return;
  }
  const PictureFaults faults = JudgePictures(pass.snapshot->terrain->stereo_quality, role_);
  if (faults.frozen() || faults.blank() || faults.swapped) {
    return;  // what it shows is no ground of now
  }
  WatchLaserSpot(*range);
  if (const auto spot = LaserSpot(*pass.snapshot)) {
    range_check_.Add(*range, *spot);
    pass.snapshot->terrain.Edit().range_agreement = range_check_.agreement();
  }
  slad_.Add({.view = {pass.pair.left, pass.pair.right, range},
             .p_WB = navigator_.PredictBodyPose(range->time).p},
            settings.slad);
  pass.new_map = true;
  maps_to_rebuild_ = std::max(0, maps_to_rebuild_ - 1);
}

void Pipeline::Judge(Pass& pass) {
  TerrainPart& terrain = pass.snapshot->terrain.Edit();
  if (!slad_.has_map() || (!pass.new_map && !pass.settings_moved)) {
    pass.decision_of_record = terrain.OfRecord();
    return;
  }
  const auto& armed = mission_.status().armed;
  slad_.Keep(SeenFromStart(role_) && armed ? armed->id : 0);
  // Letters follow the limits of record; a preview or a re-decision uses a copy of them.
  pass.decision_of_record =
      DecisionUnder(settings_.recorded(), pass.new_map ? Letters::kOfRecord : Letters::kOfCopy);
  terrain.applied = settings_.redecided() ? DecisionUnder(settings_.applied(), Letters::kOfCopy)
                                          : pass.decision_of_record;
  terrain.recorded = settings_.redecided() ? pass.decision_of_record : nullptr;
  terrain.preview =
      settings_.previewing() ? DecisionUnder(settings_.preview(), Letters::kOfCopy) : nullptr;
}

std::optional<LandingSite> Pipeline::TrackedSite(Timestamp now) const {
  if (!SeenFromStart(role_)) {
    return mission_of_record_.TrackedSite(now);
  }
  return mission_.WantsTracking() ? mission_.status().armed : std::nullopt;
}

void Pipeline::Track(Pass& pass) {
  EngineSnapshot& snapshot = *pass.snapshot;
  const std::optional<LandingSite> armed = TrackedSite(pass.bundle->time);
  const TrackingSettings& tracking = settings_.recorded().tracking;
  navigator_.AllowVision(SeenFromStart(role_) ? mission_.VisionAllowed() : armed.has_value());
  if (!armed) {
    if (tracked_site_ != 0) {
      tracker_.Reset();
      navigator_.StopVision();
      tracked_site_ = 0;
    }
    snapshot.flight.Edit().tracker = TrackerStatus{};
  } else if (pass.pair.left) {
    const Timestamp exposure = pass.bundle->stereo->time;
    const RangeMap* range = pass.new_map ? snapshot.terrain->range.get() : nullptr;
    if (tracked_site_ != armed->id) {
      tracker_.Reset();
      tracker_.Lock(*pass.pair.left, rectifier_->camera(), snapshot.sensors->X_WC, range, *armed,
                    tracking, exposure);
      navigator_.StartVision(*armed, exposure);
      tracked_site_ = armed->id;
    }
    const TrackResult result = tracker_.Track(*pass.pair.left, rectifier_->camera(),
                                              snapshot.sensors->X_WC, range, tracking, exposure);
    snapshot.flight.Edit().tracker = result.status;
    navigator_.AddVision(result, rectifier_->camera(), *rig_, *pass.bundle, tracking);
    snapshot.sensors.Edit().X_WC = navigator_.PredictBodyPose(exposure) * rectifier_->X_BC(*rig_);
  }
  NavigationStatus& navigation = snapshot.flight.Edit().navigation;
  navigation = navigator_.status();
  navigation.image_time_left = image_time_.left();
  navigation.image_time_right = image_time_.right();
  navigation.laser = laser_watch_.status();
}

/// Of the estimate in force: its own time is now as long as inertia carries it on.
Timestamp Pipeline::LastMeasured(const EngineSnapshot& snapshot) const {
  const FilterStatus& filter = navigator_.status().InForce();
  if (filter.running) {
    return AddSeconds(snapshot.time, -filter.coasting_s);
  }
  return snapshot.sensors->pose ? snapshot.sensors->pose->time : snapshot.time;
}

void Pipeline::Decide(Pass& pass) {
  EngineSnapshot& snapshot = *pass.snapshot;
  PositionEstimate estimate = navigator_.EstimateInForce(pass.bundle->time);
  if (estimate.source != EstimateSource::kNone) {
    channels_.AddEstimate(LastMeasured(snapshot), estimate.source);
  }
  snapshot.sensors.Edit().channels = channels_.Health(pass.bundle->time);
  const Eigen::Matrix3d R_WB =
      snapshot.sensors->pose ? snapshot.sensors->pose->X_WB.R : Eigen::Matrix3d::Identity();
  std::optional<LandingSite> rechecked, alternative;
  std::optional<NearestHazard> nearest;
  const auto& armed = mission_.status().armed;
  if (armed && pass.decision_of_record && pass.new_map) {
    const auto& approach = mission_.status().approach;
    rechecked = slad_.Recheck(*pass.decision_of_record, *armed, settings_.recorded(),
                              approach ? approach->heading_rad : NAN);
    if (rechecked) {
      const TerrainDecision& map = *pass.decision_of_record;
      nearest = ExplainCell(*map.elevation, *map.hazards, map.settings, rechecked->cell).nearest;
    }
    if (const auto& kept = mission_.alternative()) {
      alternative = slad_.Recheck(*pass.decision_of_record, *kept, settings_.recorded(), NAN);
    }
  }
  const Settings& in_force = settings_.recorded();
  mission_.Update({
      .session = MissionSession(pass, pass.bundle->time),
      .vehicle = {.bundle = *pass.bundle,
                  .channels = snapshot.sensors->channels,
                  .simulated = snapshot.sensors->vehicle && snapshot.sensors->vehicle->simulated},
      .terrain = {.decision = pass.decision_of_record.get(),
                  .new_map = pass.new_map,
                  .forgotten = pass.forgotten,
                  .rechecked = rechecked,
                  .nearest = nearest,
                  .alternative = alternative},
      .navigation = {.navigation = snapshot.flight->navigation,
                     .tracker = snapshot.flight->tracker,
                     .stereo = snapshot.terrain->stereo_quality,
                     .new_stereo = pass.new_stereo,
                     .range_agreement = snapshot.terrain->range_agreement,
                     .p_WB_estimate = estimate.p_WB,
                     .skid_centre_W = estimate.p_WB + R_WB * SkidCentreBody()},
      .limits = {.settings = in_force,
                 .settings_hash = HashOf(in_force),
                 .calibration_hash = calibration_hash_},
  });
  snapshot.flight.Edit().mission =
      SeenFromStart(role_) ? mission_.status()
                           : mission_of_record_.StatusAt(pass.bundle->time, mission_.status());
}

MissionInputs::Session Pipeline::MissionSession(const Pass& pass, Timestamp now) const {
  const SessionStatus& session = pass.session;
  return {.now = now,
          .role = role_,
          .why_no_vehicle = WhyNoVehicle(session.source.kind),
          .can_transmit = session.can_transmit,
          .recorder_ok = session.recorder_ok,
          .record = session.record,
          .engine_stop = session.engine_stop,
          .source_damage = session.source.damage,
          .losses = session.losses,
          .authority = session.authority,
          .snapshot_sequence = sequence_};
}

PipelineOutput Pipeline::Publish(Pass& pass) {
  EngineSnapshot& snapshot = *pass.snapshot;
  SessionPart& part = snapshot.session.Edit();
  part.role = role_;
  snapshot.sequence = ++sequence_;
  part.source = pass.session.source;
  part.losses = pass.session.losses;
  part.missing_inputs = MissingInputs(snapshot, part.losses);
  snapshot.terrain.Edit().maps_to_rebuild = maps_to_rebuild_;
  part.can_transmit = pass.session.can_transmit;
  part.authority = pass.session.authority;
  part.recording = pass.session.recording;
  part.recording_path = pass.session.recording_path;
  part.record = pass.session.record;
  part.settings = settings_.applied();
  part.preview_settings = settings_.preview();
  part.settings_hash = HashOf(part.settings);
  part.preview_hash = HashOf(part.preview_settings);
  part.limits_apply = WhenLimitsApply(/*of_record=*/false);
  part.apply_drops = part.limits_apply == LimitsApply::kWhenApplied && mission_.DropsWithSettings();
  part.recorded_settings = settings_.recorded();
  part.events = EventsAt(snapshot.time);
  const bool new_time = !last_ || last_->time != snapshot.time;
  if (new_time && pass.bundle) {
    history_.Add(SampleOf(snapshot, *pass.bundle));
  }
  snapshot.flight.Edit().history = history_.Publish();
  snapshot.decision_hash = DecisionHash(snapshot);

  PipelineOutput output;
  output.commands = std::move(pass.commands);
  output.messages = mission_.TakeMessages();
  if (new_time && pass.bundle) {
    PositionEstimate estimate = navigator_.EstimateInForce(snapshot.time);
    if (estimate.source != EstimateSource::kNone) {
      estimate.approval_id = mission_.status().approval ? mission_.status().approval->id : 0;
      output.messages.emplace_back(estimate);
    }
  }
  last_ = pass.snapshot;
  output.snapshot = std::move(pass.snapshot);
  return output;
}

}  // namespace palace
