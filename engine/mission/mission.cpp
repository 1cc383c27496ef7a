#include "engine/mission/mission.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr double kRepeat_s = 0.5;
constexpr double kShownMemory_s = 5;
constexpr std::size_t kMostEvents = 20000;
/// A proposed site may miss this many maps before the proposal ends.
constexpr int kProposalMissing = 2;

std::uint32_t SessionPart(std::uint64_t session_id) {
  return static_cast<std::uint32_t>(session_id ^ (session_id >> 32));
}

}  // namespace

Mission::Mission(MissionOptions options) : options_(std::move(options)) {
  status_.why = "No data yet";
  status_.height_above_site_m = status_.distance_to_site_m = status_.time_to_touchdown_s = NAN;
}

void Mission::AddEvent(Timestamp time, EventKind kind, std::string text) {
  if (events_.size() >= kMostEvents) {
    events_.erase(events_.begin(), events_.begin() + kMostEvents / 2);
  }
  events_.push_back({time, kind, std::move(text)});
}

std::vector<VehicleMessage> Mission::TakeMessages() { return std::exchange(outbox_, {}); }

bool Mission::WantsTracking() const {
  return status_.armed.has_value() &&
         (status_.state == MissionState::kArmed || status_.state == MissionState::kApproved ||
          status_.state == MissionState::kDescending || status_.state == MissionState::kHold);
}
bool Mission::VisionAllowed() const { return vision_allowed_; }
bool Mission::SettingsFrozen() const { return status_.state >= MissionState::kArmed; }

void Mission::DropApproval(std::string_view why) {
  if (status_.state == MissionState::kArmed || status_.state == MissionState::kApproved) {
    Drop(std::string(why), facts_.now);
  }
}

void Mission::Send(VehicleMessage message) {
  // Nothing of a replay or of mere pictures may reach a vehicle, whoever holds a link (I7).
  if (facts_.source_kind == SourceKind::kReplay || HasPicturesOnly(facts_.source_kind)) {
    return;
  }
  outbox_.push_back(std::move(message));
}

void Mission::Enter(MissionState state, std::string why, Timestamp now) {
  AddEvent(now, EventKind::kState, std::string(MissionStateName(state)) + ": " + why);
  status_.state = state;
  status_.since = now;
  status_.why = std::move(why);
  const bool keeps_vision = state == MissionState::kApproved ||
                            state == MissionState::kDescending || state == MissionState::kHold ||
                            state == MissionState::kLanded;
  vision_allowed_ = vision_allowed_ && keeps_vision;
}

void Mission::ForgetSite() {
  status_.armed.reset();
  status_.arm_expires.reset();
  status_.guards.clear();
  armed_ = {};
  site_ = {};
  told_ = SiteVerdict::kHolds;
  alternative_.reset();
}

void Mission::Kill(std::string_view why) {
  repeating_.reset();
  if (!status_.approval) {
    return;
  }
  dead_approval_id_ = status_.approval->id;
  AddEvent(facts_.now, EventKind::kDecision,
           "Approval of " + SiteName() + " ended: " + std::string(why));
  status_.approval.reset();
  if (status_.approval_phase != MissionStatus::ApprovalPhase::kRefused) {
    status_.approval_phase = MissionStatus::ApprovalPhase::kNone;
  }
}

void Mission::Drop(std::string why, Timestamp now) {
  // An approval on its way must be withdrawn; one that the vehicle refused is nowhere.
  const bool withdraw = status_.state == MissionState::kApproved &&
                        status_.approval_phase != MissionStatus::ApprovalPhase::kRefused;
  Kill(why);
  if (withdraw) {
    hold_id_ =
        (std::uint64_t{SessionPart(options_.session_id)} << 32) | 0x80000000U | ++request_counter_;
    repeating_ = HoldRequest{hold_id_, "Approval withdrawn: " + why};
    sent_at_ = now;
    Send(*repeating_);
  }
  ForgetSite();
  Enter(MissionState::kProposed, std::move(why), now);
}

void Mission::Hold(std::string why, Timestamp now) {
  Kill(why);
  hold_id_ =
      (std::uint64_t{SessionPart(options_.session_id)} << 32) | 0x80000000U | ++request_counter_;
  repeating_ = HoldRequest{hold_id_, why};
  sent_at_ = now;
  Send(*repeating_);
  winner_ = {};  // the next proposal must win fresh maps
  Enter(MissionState::kHold, std::move(why), now);
}

void Mission::Abort(std::string why, Timestamp now) {
  Kill(why);
  abort_id_ =
      (std::uint64_t{SessionPart(options_.session_id)} << 32) | 0x80000000U | ++request_counter_;
  repeating_ = AbortRequest{abort_id_, why};
  sent_at_ = now;
  Send(*repeating_);
  if (status_.state == MissionState::kAborting) {
    return;  // pressed again: one more message, the same wave-off
  }
  abort_seen_ = wave_off_acknowledged_ = false;
  winner_ = {};
  Enter(MissionState::kAborting, std::move(why), now);
}

void Mission::Repeat(Timestamp now) {
  if (repeating_ && SecondsBetween(sent_at_, now) >= kRepeat_s) {
    Send(*repeating_);
    sent_at_ = now;
  }
}

bool Mission::IsApproval(std::uint64_t id, std::uint64_t own) const {
  // A log carries its own session part, and after a seek its numbers run ahead of ours. What stays
  // is the kind: requests have the top bit of the number set, approvals do not.
  const bool same_kind = ((id ^ own) & 0x80000000U) == 0;
  return own != 0 && id != 0 &&
         (id == own || (facts_.source_kind == SourceKind::kReplay && same_kind));
}
bool Mission::OwnApproval(std::uint64_t id) const {
  return status_.approval && IsApproval(id, status_.approval->id);
}

std::string Mission::SiteName() const {
  return status_.armed ? std::string("site ") + status_.armed->letter : std::string("the site");
}

double Mission::HeightAboveSite() const {
  // Down is positive in W: the skid is above the site when its z is smaller.
  return status_.armed ? status_.armed->p_WS.z() - facts_.skid_centre_W.z() : NAN;
}

bool Mission::Executing() const {
  if (!watch_.vehicle() || watch_.vehicle()->approval_id == 0) {
    return false;
  }
  const VehicleMode mode = watch_.vehicle()->mode;
  return mode == VehicleMode::kAlign || mode == VehicleMode::kDescend ||
         mode == VehicleMode::kSettle || mode == VehicleMode::kSink;
}

void Mission::Update(const MissionInputs& inputs) {
  FollowJump(inputs);
  watch_.Update(inputs.bundle, inputs.channels, inputs.now);
  RememberFacts(inputs);
  FollowWinner(inputs);
  FollowSite(inputs);
  FollowAcks(inputs);
  FollowDeadApproval(inputs);
  Step(inputs);
  Repeat(inputs.now);
  Publish(inputs);
}

void Mission::RestartReplay(Timestamp now) {
  ForgetSite();
  repeating_.reset();
  status_.refused_sites.clear();  // letters start anew
  refusal_.clear();
  alarms_ = {};
  counter_ = request_counter_ = dead_approval_id_ = hold_id_ = abort_id_ = 0;
  status_.approval.reset();
  status_.approval_phase = MissionStatus::ApprovalPhase::kNone;
  status_.approval_answer.clear();
  status_.rechecks.clear();
  status_.touchdown_miss_m.reset();
  status_.touchdown_miss_true_m.reset();
  Enter(MissionState::kNoLive, "Jumped in time", now);
}

void Mission::FollowJump(const MissionInputs& in) {
  if (!facts_.valid || (!in.bundle.discontinuity && in.now >= facts_.now)) {
    return;
  }
  // Ages across a jump mean nothing: forget every arrival, wait for three new samples (I18).
  watch_ = {};
  shown_.clear();
  winner_ = {};
  facts_.now = sent_at_ = status_.since = vision_good_at_ = in.now;
  if (in.source_kind == SourceKind::kReplay || HasPicturesOnly(in.source_kind)) {
    RestartReplay(in.now);
  } else if (status_.state == MissionState::kArmed || status_.state == MissionState::kApproved) {
    Drop("Time jumped", in.now);
  } else if (status_.state == MissionState::kDescending) {
    Hold("Time jumped", in.now);
  }
}

void Mission::RememberFacts(const MissionInputs& in) {
  facts_.valid = true;
  vehicle_ever_heard_ = vehicle_ever_heard_ || watch_.heard_vehicle();
  facts_.now = in.now;
  facts_.source_kind = in.source_kind;
  facts_.simulated_vehicle = in.simulated_vehicle;
  facts_.settings_hash = in.settings_hash;
  facts_.calibration_hash = in.calibration_hash;
  facts_.limits = in.settings.mission;
  facts_.commit_height_m = in.settings.slad.fusion.commit_height_m;
  facts_.skid_centre_W = in.skid_centre_W;
  facts_.approach_heading_rad = in.approach_heading_rad;
  if (in.applied != nullptr) {
    facts_.sites = in.applied->selection.sites;
    facts_.map_hash = in.applied->map_hash;
    facts_.terrain_settings_hash = in.applied->settings_hash;
  } else {
    facts_.sites.clear();
    facts_.map_hash = 0;
  }
  if (in.new_map && in.applied != nullptr) {
    map_seen_at_ = in.now;
  }
  const NavigationStatus& nav = in.navigation;
  const bool on_vision = nav.handover == NavigationStatus::Handover::kVision;
  const FilterStatus& filter = on_vision ? nav.vision : nav.gps;
  facts_.speed_mps = filter.estimate.v_WB.norm();
  if (nav.vision.running && nav.vision.estimate.healthy) {
    vision_good_at_ = in.now;
  }
  GuardInputs& guards = facts_.guards;
  guards.position_healthy = in.p_WB_estimate.allFinite() && in.skid_centre_W.allFinite() &&
                            filter.running && filter.estimate.healthy;
  guards.tracker_locked = in.tracker.locked;
  guards.coherence = in.tracker.coherence;
  guards.min_coherence = in.settings.tracking.min_coherence;
  guards.can_transmit = in.can_transmit;
  guards.recorder_ok = in.recorder_ok;
  guards.arm_window_s = in.settings.mission.arm_window_s;
  shown_.emplace_back(in.snapshot_sequence + 1, in.now);
  while (shown_.size() > 1 && SecondsBetween(shown_.front().second, in.now) > kShownMemory_s) {
    shown_.pop_front();
  }
}

void Mission::FollowWinner(const MissionInputs& in) {
  if (!in.new_map || in.applied == nullptr) {
    return;
  }
  const LandingSite* best = status_.BestStanding(facts_.sites);
  if (best == nullptr) {
    winner_ = {};
    return;
  }
  const bool refused = status_.IsRefused(winner_.id);
  const bool listed = FindSite(winner_.id) != nullptr && !refused;
  const bool proposed = status_.state >= MissionState::kProposed;
  if (best->id == winner_.id || (proposed && listed)) {
    ++winner_.maps;
    winner_.missing = 0;
  } else if (proposed && winner_.id != 0 && !refused && winner_.missing < kProposalMissing) {
    ++winner_.missing;
  } else {
    winner_ = {best->id, 1, 0, in.now};
  }
}

bool Mission::WinnerStands(Timestamp now) const {
  return winner_.id != 0 && winner_.maps >= facts_.limits.propose_after_maps &&
         SecondsBetween(winner_.since, now) >= facts_.limits.propose_after_s &&
         SecondsBetween(map_seen_at_, now) <= GuardLimits::map_s;
}

void Mission::FollowAcks(const MissionInputs& in) {
  using Phase = MissionStatus::ApprovalPhase;
  for (const CommandAck& ack : in.bundle.acks) {
    if (OwnApproval(ack.command_id) && status_.approval_phase == Phase::kSent) {
      const bool accepted = ack.result == AckResult::kAccepted;
      repeating_.reset();
      status_.approval_answer_s = SecondsBetween(approved_now_, in.now);
      status_.approval_answer = ack.reason;
      status_.approval_phase = accepted ? Phase::kAccepted : Phase::kRefused;
      AddEvent(in.now, EventKind::kVehicle,
               accepted ? "Vehicle accepted the approval of " + SiteName()
                        : "Vehicle refused the approval of " + SiteName() + ": " + ack.reason);
      vision_allowed_ = accepted;
      if (!accepted) {
        refusal_ = "Vehicle refused " + SiteName() + ": " + ack.reason;
        Drop(refusal_, in.now);
      }
    } else if (IsApproval(ack.command_id, hold_id_) && repeating_ &&
               std::holds_alternative<HoldRequest>(*repeating_)) {
      repeating_.reset();
    } else if (IsApproval(ack.command_id, abort_id_)) {
      abort_seen_ = abort_seen_ || ack.result == AckResult::kAccepted ||
                    (watch_.vehicle() && watch_.vehicle()->on_ground);
    }
  }
}

void Mission::FollowDeadApproval(const MissionInputs& in) {
  const bool searching = status_.state <= MissionState::kArmed;
  if (searching && in.bundle.status && Executing() &&
      watch_.vehicle()->approval_id == dead_approval_id_) {
    Hold("Vehicle flies a withdrawn approval", in.now);
  }
}

}  // namespace palace
