#include "engine/mission/arrivals.h"

#include "engine/mission/going.h"
#include "engine/mission/wording.h"
#include "engine/model/settings/sound_settings.h"

namespace palace {
namespace {

constexpr double kShownMemory_s = 5;

/// Another place of a record: nothing of the one before holds there.
void StartAnew(MissionTurn& turn, Timestamp now) {
  MissionMemory& m = turn.memory;
  ForgetSite(m);
  m.repeating.reset();
  m.refusal.clear();
  m.alarms = {};
  m.pictures = {};
  m.approvals_given = m.requests_made = m.dead_approval_id = 0;
  m.hold_id = m.abort_id = m.go_id = 0;
  m.status.going.reset();
  m.status.refused_sites.clear();  // letters start anew
  m.status.approval.reset();
  m.status.approval_phase = MissionStatus::ApprovalPhase::kNone;
  m.status.approval_answer.clear();
  m.status.rechecks.clear();
  m.status.touchdown_miss_m.reset();
  m.status.touchdown_miss_true_m.reset();
  m.status.touchdown_sink_mps.reset();
  Enter(turn, MissionState::kNoLive, words::kJumped, now);
}

void RememberNavigation(MissionFacts& facts, const MissionInputs::Navigation& in) {
  const FilterStatus& filter = in.navigation.InForce();
  facts.navigation = in.navigation;
  facts.stereo = in.stereo;
  facts.range_agreement = in.range_agreement;
  const bool unknown = filter.running && filter.IsUnknown();
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(NAN);
  facts.skid_centre_W = unknown ? nowhere : in.skid_centre_W;
  facts.p_WB = unknown ? nowhere : in.p_WB_estimate;
  facts.v_WB = unknown ? nowhere : filter.estimate.v_WB;
  facts.position_healthy = in.p_WB_estimate.allFinite() && in.skid_centre_W.allFinite() &&
                           filter.running && filter.estimate.healthy && !unknown;
  facts.tracker_locked = in.tracker.locked;
  facts.why_not_locked = in.tracker.why_not_locked;
  facts.trackers_apart = in.why_not_trusted;
  facts.coherence = in.tracker.coherence;
}

void RememberVehicle(MissionFacts& facts, const MissionInputs::Vehicle& in) {
  facts.simulated_vehicle = in.simulated;
  if (in.bundle.pose_at_exposure) {
    facts.yaw_rad = EulerFromRotation(in.bundle.pose_at_exposure->X_WB.R).yaw_rad;
  } else if (!in.bundle.poses.empty()) {
    facts.yaw_rad = EulerFromRotation(in.bundle.poses.back().X_WB.R).yaw_rad;
  }
  if (in.bundle.rig) {
    facts.p_BC = in.bundle.rig->position_body_m;
  }
}

void RememberTerrain(MissionFacts& facts, const TerrainDecision* decision) {
  if (decision == nullptr) {
    facts.sites.clear();
    facts.elevation.reset();
    facts.map_hash = 0;
    return;
  }
  facts.sites = decision->selection.sites;
  facts.elevation = decision->elevation;
  facts.site_limits = decision->settings;
  facts.map_hash = decision->map_hash;
  facts.terrain_settings_hash = decision->settings_hash;
}

void RememberShown(MissionMemory& m, const MissionInputs::Session& in) {
  m.shown.push_back({in.snapshot_sequence + 1, in.now});
  while (m.shown.size() > 1 && SecondsBetween(m.shown.front().time, in.now) > kShownMemory_s) {
    m.shown.pop_front();
  }
}

void TakeApprovalAnswer(MissionTurn& turn, const CommandAck& ack, Timestamp now) {
  using Phase = MissionStatus::ApprovalPhase;
  MissionMemory& m = turn.memory;
  const bool accepted = ack.result == AckResult::kAccepted;
  m.repeating.reset();
  m.status.approval_answer_s = SecondsBetween(m.approved_at, now);
  m.status.approval_answer = ack.reason;
  m.status.approval_phase = accepted ? Phase::kAccepted : Phase::kRefused;
  const std::string site = words::Approved(m.status);
  AddEvent(
      turn, now, EventKind::kVehicle,
      accepted ? words::VehicleAccepted(site) : words::VehicleRefusedApproval(site, ack.reason));
  m.vision_allowed = accepted;
  if (!accepted) {
    m.refusal = words::VehicleRefused(site, ack.reason);
    Drop(turn, m.refusal, now);
  }
}

/// Of an approval that flies: the vehicle gives it up. Of a hold, which is repeated, and of what
/// nobody here waits for: told at most once a second, for anybody can make a vehicle refuse.
void TellRefusal(MissionTurn& turn, const CommandAck& ack, Timestamp now) {
  MissionMemory& m = turn.memory;
  const bool hold = IsSameMessage(m, ack.command_id, m.hold_id);
  // The window sends a hold at once, the mission one with its step: one of the two comes too late.
  if (hold && m.watch.vehicle() && m.watch.vehicle()->mode == VehicleMode::kHold) {
    return;
  }
  if (IsOwnApproval(m, ack.command_id)) {
    m.vehicle_reason = ack.reason;
    AddEvent(turn, now, EventKind::kVehicle, "Vehicle gives up the approval: " + ack.reason);
  } else if (SecondsBetween(m.foreign_told_at, now) >= 1) {
    m.foreign_told_at = now;
    AddEvent(turn, now, EventKind::kVehicle,
             (hold ? "Vehicle refused the hold: " : "Vehicle refused a command: ") + ack.reason);
  }
}

}  // namespace

void FollowJump(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  const Timestamp now = in.session.now;
  if (!m.facts.valid || (!in.vehicle.bundle.discontinuity && now >= m.facts.now)) {
    return;
  }
  m.watch = FollowsRecord(in.session.role)
                ? InputWatch::AsHeard(in.vehicle.channels, in.vehicle.bundle, now)
            : StartsAnewAfterJump(in.session.role) ? InputWatch()
                                                   : m.watch.AfterJump();
  m.energy.Forget();
  m.shown.clear();
  m.went_at.reset();
  m.winner = {};
  m.facts.now = m.sent_at = m.status.since = m.vision_good_at = m.ground_seen_at = now;
  m.wave_off_at = m.abort_answered_at = m.foreign_told_at = m.told_foreign_at = now;
  const auto& clock = in.vehicle.bundle.arrival.clock;
  const std::string why =
      clock && clock->stepped_s != 0 ? words::ClockStepped(clock->stepped_s) : words::kTimeJumped;
  if (StartsAnewAfterJump(in.session.role)) {
    StartAnew(turn, now);
  } else if (m.status.state == MissionState::kArmed || m.status.state == MissionState::kApproved) {
    Drop(turn, why, now);
  } else if (m.status.state == MissionState::kDescending) {
    Hold(turn, why, now);
  }
}

void HearSession(MissionFacts& facts, const MissionInputs::Session& in) {
  facts.role = in.role;
  facts.why_no_vehicle = in.why_no_vehicle;
  facts.can_transmit = facts.can_transmit && in.can_transmit;
  facts.authority = in.authority;
  facts.recorder_ok = facts.recorder_ok && in.recorder_ok;
}

void RememberEnergy(MissionMemory& m, const MissionInputs& in) {
  if (m.watch.rebooted()) {
    m.energy.Forget();
  }
  if (in.vehicle.bundle.status) {
    m.energy.Update(in.vehicle.bundle.status->battery_or_fuel, in.session.now);
  }
  m.status.energy = m.energy.Left();
}

void RememberFacts(MissionMemory& m, const MissionInputs& in) {
  MissionFacts& facts = m.facts;
  if (!facts.valid || facts.settings_hash != in.limits.settings_hash) {
    facts.unusual_settings = OutsideUsual(in.limits.settings);
  }
  facts.valid = true;
  facts.now = in.session.now;
  facts.role = in.session.role;
  facts.why_no_vehicle = in.session.why_no_vehicle;
  facts.can_transmit = in.session.can_transmit;
  facts.authority = in.session.authority;
  facts.recorder_ok = in.session.recorder_ok;
  facts.settings = in.limits.settings;
  facts.settings_hash = in.limits.settings_hash;
  facts.calibration_hash = in.limits.calibration_hash;
  RememberTerrain(facts, in.terrain.decision);
  RememberNavigation(facts, in.navigation);
  RememberVehicle(facts, in.vehicle);
  m.vehicle_ever_heard = m.vehicle_ever_heard || m.watch.heard_vehicle();
  const VehicleMode mode = m.watch.vehicle() ? m.watch.vehicle()->mode : VehicleMode::kUnknown;
  if (mode != m.flown_mode) {
    m.flown_mode = mode;
    m.flown_since = in.session.now;
  }
  if (in.navigation.new_stereo) {
    m.pictures.Update(JudgePictures(in.navigation.stereo, in.session.role));
  }
  if (in.terrain.new_map && in.terrain.decision != nullptr) {
    m.map_seen_at = in.session.now;
  }
  if (m.watch.vehicle() && !m.watch.vehicle()->on_ground) {
    m.sink_mps = facts.v_WB.z();
  }
  const FilterStatus& vision = in.navigation.navigation.vision;
  if (vision.running && vision.estimate.healthy) {
    m.vision_good_at = in.session.now;
  }
  m.lost_share = LostShare(in.vehicle.channels);
  m.losers = LosersWords(in.vehicle.channels);
  RememberShown(m, in.session);
}

void FollowWinner(MissionMemory& m, const MissionInputs& in) {
  if (in.terrain.forgotten) {
    m.winner = {};
  }
  if (!in.terrain.new_map || in.terrain.decision == nullptr) {
    return;
  }
  const LandingSite* best = m.status.BestStanding(m.facts.sites);
  // A proposal is of every site that is listed: it does not end because another leads.
  const bool proposed = WinnerStands(m, in.session.now);
  if (best == nullptr) {
    m.winner = {};
  } else if (best->id == m.winner.site_id || proposed) {
    m.winner = {best->id, m.winner.maps + 1, m.winner.since};
  } else {
    m.winner = {best->id, 1, in.session.now};
  }
}

void FollowAuthority(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  const AuthorityStatus& authority = in.session.authority;
  const ForeignTraffic& foreign = authority.foreign;
  const Timestamp now = in.session.now;
  if (in.session.role != SessionRole::kLive) {
    return;
  }
  if (authority.standing != m.told_standing) {
    m.told_standing = authority.standing;
    AddEvent(turn, now, EventKind::kVehicle,
             authority.commands() ? words::Commands(authority.fingerprint) : authority.why_not);
  }
  // At most one a second: whoever sends may send many.
  if (foreign.count > m.told_foreign && SecondsBetween(m.told_foreign_at, now) >= 1) {
    m.told_foreign = foreign.count;
    m.told_foreign_at = now;
    AddEvent(turn, now, EventKind::kVehicle, words::ForeignCommand(foreign));
  }
}

void FollowAnswers(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  for (const CommandAck& ack : in.vehicle.bundle.acks) {
    if (IsOwnApproval(m, ack.command_id) &&
        m.status.approval_phase == MissionStatus::ApprovalPhase::kSent) {
      TakeApprovalAnswer(turn, ack, in.session.now);
    } else if (ack.result == AckResult::kAccepted && m.repeating &&
               IsSameMessage(m, ack.command_id, m.hold_id) &&
               std::holds_alternative<HoldRequest>(*m.repeating)) {
      m.repeating.reset();
    } else if (m.status.going && !m.status.going->accepted && m.repeating &&
               IsSameMessage(m, ack.command_id, m.go_id) &&
               std::holds_alternative<GoRequest>(*m.repeating)) {
      TakeGoAnswer(turn, ack, in.session.now);
    } else if (IsSameMessage(m, ack.command_id, m.abort_id)) {
      // Told, no more: the repeats end by what the vehicle's status shows.
      const bool accepted = ack.result == AckResult::kAccepted;
      m.abort_answered_at = accepted ? in.session.now : m.abort_answered_at;
    } else if (ack.result == AckResult::kRefused) {
      TellRefusal(turn, ack, in.session.now);
    }
  }
}

void StopDeadApproval(MissionTurn& turn, const MissionInputs& in) {
  const MissionMemory& m = turn.memory;
  const bool searching = m.status.state <= MissionState::kArmed;
  if (searching && in.vehicle.bundle.status && Executing(m) &&
      m.watch.vehicle()->approval_id == m.dead_approval_id) {
    Hold(turn, words::kFliesWithdrawn, in.session.now);
  }
}

}  // namespace palace
