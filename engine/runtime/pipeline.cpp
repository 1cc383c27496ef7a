#include "engine/runtime/pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/model/mission/picture_faults.h"
#include "engine/runtime/decision_hash.h"
#include "engine/runtime/missing_inputs.h"
#include "engine/runtime/pipeline_pass.h"
#include "engine/slad/hazards/explanation.h"

namespace palace {
namespace {

/// Why the left picture is none of now, by its last map; empty when nothing says so, and where no
/// map is made: nobody would take it back. A position taken from it would hold still while the
/// vehicle moves.
std::string WhyNotOfNow(const TerrainPart& terrain, SessionRole role) {
  if (!terrain.why_no_map.empty()) {
    return "";
  }
  const PictureFaults faults = JudgePictures(terrain.stereo_quality, role);
  return faults.left_blank    ? "the camera shows nothing"
         : faults.left_frozen ? "the camera repeats its picture"
                              : "";
}

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
  if (last != nullptr) {
    injected_faults_ = last->session->injected_faults;
    if (last->session->source.simulation) {
      setup_changes_.GoOnAfter(last->session->source.simulation->in_force);
    }
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
  rate_attitude_.Reset();
  beam_ground_m_ = NAN;
  channels_.Reset();
  if (FollowsRecord(role_)) {
    role_ = SessionRole::kReplayedAfterJump;
    channels_.RestoreHeard(mission_of_record_.HeardBefore(now));
    restored_ = mission_of_record_.StatusAt(now, mission_.status());
  }
  if (const Settings* settings =
          FollowsRecord(role_) ? mission_of_record_.SettingsAt(now) : nullptr) {
    settings_.RestoreRecorded(*settings);
    if (const RecordedProposal* proposal = mission_of_record_.ProposalAt(now)) {
      slad_.GoOnWith(proposal->places, settings->slad);
    }
  }
  std::vector<HistorySample> before = mission_of_record_.HistoryBefore(now);
  maps_to_rebuild_ =
      FollowsRecord(role_) && (!before.empty() || mission_of_record_.BeginsMidFlight())
          ? settings_.recorded().slad.fusion.frames_fused
          : 0;
  from_start_ = maps_to_rebuild_ == 0;
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
  slad_.WaitForMemory(!HasPicturesOnly(role_));
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
  NoteSimulation(pass);
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

const MissionStatus& Pipeline::MissionInForce() const {
  return SeenFromStart(role_) ? mission_.status() : last_ ? last_->flight->mission : restored_;
}

void Pipeline::Judge(Pass& pass) {
  TerrainPart& terrain = pass.snapshot->terrain.Edit();
  if (!slad_.has_map() || (!pass.new_map && !pass.settings_moved)) {
    pass.decision_of_record = terrain.OfRecord();
    return;
  }
  const auto& armed = mission_.status().armed;
  slad_.Keep(SeenFromStart(role_) && armed ? &*armed : nullptr);
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
    snapshot.flight.Edit().trackers = TrackerSetStatus{};
  } else if (pass.pair.left) {
    const Timestamp exposure = pass.bundle->stereo->time;
    TrackResult result;
    result.time = result.status.time = exposure;
    result.status.why_not_locked = WhyNotOfNow(*snapshot.terrain, role_);
    if (result.status.why_not_locked.empty()) {
      const RangeMap* range = pass.new_map ? snapshot.terrain->range.get() : nullptr;
      // Of ground that had too little to hold on to the next map may measure more.
      if (tracked_site_ != armed->id || (range != nullptr && !tracker_.anchored())) {
        tracker_.Reset();
        tracker_.Lock(*pass.pair.left, rectifier_->camera(), snapshot.sensors->X_WC, range, *armed,
                      tracking, exposure);
        navigator_.StartVision(*armed, exposure);
        tracked_site_ = armed->id;
      }
      result = tracker_.Track(*pass.pair.left, rectifier_->camera(), snapshot.sensors->X_WC, range,
                              tracking, exposure);
    } else if (tracked_site_ == armed->id) {
      result.set = tracker_.Coast(rectifier_->camera(), snapshot.sensors->X_WC, tracking,
                                  result.status.why_not_locked, exposure);
    }
    snapshot.flight.Edit().tracker = result.status;
    snapshot.flight.Edit().trackers = result.set;
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
                     .why_not_trusted = snapshot.flight->trackers.consensus.why_not_trusted,
                     .stereo = snapshot.terrain->stereo_quality,
                     .new_stereo = pass.new_stereo,
                     .range_agreement = snapshot.terrain->range_agreement,
                     .p_WB_estimate = estimate.p_WB,
                     .skid_centre_W = estimate.p_WB + R_WB * in_force.slad.lander.skid_centre_B()},
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
  part.injected_faults = FollowsRecord(role_) ? ActingFaults(*part.events) : injected_faults_;
  const bool new_time = !last_ || last_->time != snapshot.time;
  if (new_time && pass.bundle) {
    HistorySample sample = SampleOf(snapshot, *pass.bundle);
    sample.new_map = pass.new_map;
    history_.Add(std::move(sample));
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
