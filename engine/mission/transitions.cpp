#include "engine/mission/transitions.h"

#include <utility>

#include "engine/mission/wording.h"

namespace palace {
namespace {

constexpr double kRepeat_s = 0.5;

}  // namespace

std::uint64_t ApprovalNumber(std::uint64_t session_id, std::uint64_t counter) {
  return ((session_id ^ (session_id >> 32)) << 32) | counter;
}
std::uint64_t RequestNumber(std::uint64_t session_id, std::uint64_t counter) {
  return ApprovalNumber(session_id, kRequestBit | counter);
}

void AddEvent(MissionTurn& turn, Timestamp time, EventKind kind, std::string text) {
  turn.effects.events.push_back({time, kind, std::move(text)});
}

void AddEvent(MissionTurn& turn, Timestamp time, const Alarm& alarm) {
  turn.effects.events.push_back(
      {.time = time, .kind = EventKind::kAlarm, .text = alarm.text, .level = alarm.level});
}

void Send(MissionTurn& turn, VehicleMessage message) {
  if (MaySend(turn.memory.facts.role)) {
    turn.effects.messages.push_back(std::move(message));
  }
}

void SendUntilAnswered(MissionTurn& turn, VehicleMessage message, Timestamp now) {
  turn.memory.repeating = std::move(message);
  turn.memory.sent_at = now;
  Send(turn, *turn.memory.repeating);
}

void Repeat(MissionTurn& turn, Timestamp now) {
  MissionMemory& m = turn.memory;
  if (m.repeating && SecondsBetween(m.sent_at, now) >= kRepeat_s) {
    Send(turn, *m.repeating);
    m.sent_at = now;
  }
}

void Enter(MissionTurn& turn, MissionState state, std::string why, Timestamp now) {
  MissionMemory& m = turn.memory;
  AddEvent(turn, now, EventKind::kState, std::string(MissionStateName(state)) + ": " + why);
  m.status.state = state;
  // While nothing else is selected it stays to be read.
  if (state != MissionState::kSearch && state != MissionState::kProposed) {
    m.status.selection_ended.clear();
  }
  // What is flown or waved off now is not on its way to a hover any more.
  if (IsFlying(state) || state == MissionState::kHold || state == MissionState::kAborting ||
      state == MissionState::kLanded) {
    m.status.going.reset();
  }
  m.status.since = now;
  m.status.why = std::move(why);
  const bool keeps_vision =
      IsFlying(state) || state == MissionState::kHold || state == MissionState::kLanded;
  m.vision_allowed = m.vision_allowed && keeps_vision;
}

void ForgetSite(MissionMemory& m) {
  m.status.armed.reset();
  m.status.armed_limits.clear();
  m.status.approach.reset();
  m.status.stop_height_m = 0;
  m.status.look_from_m = NAN;
  m.status.arm_expires.reset();
  m.status.guards.clear();
  m.armed = {};
  m.site = {};
  m.newest.reset();
  m.told = SiteVerdict::kHolds;
  m.alternative.reset();
}

void Kill(MissionTurn& turn, std::string_view why) {
  MissionMemory& m = turn.memory;
  m.repeating.reset();
  if (!m.status.approval) {
    return;
  }
  m.dead_approval_id = m.status.approval->id;
  AddEvent(turn, m.facts.now, EventKind::kDecision,
           words::ApprovalEnded(words::Approved(m.status), why));
  m.status.approval.reset();
  if (m.status.approval_phase != MissionStatus::ApprovalPhase::kRefused) {
    m.status.approval_phase = MissionStatus::ApprovalPhase::kNone;
  }
}

void AskToHold(MissionTurn& turn, std::string why, Timestamp now) {
  turn.memory.hold_id = RequestNumber(turn.station.session_id, ++turn.memory.requests_made);
  SendUntilAnswered(turn, HoldRequest{turn.memory.hold_id, std::move(why)}, now);
}

void Drop(MissionTurn& turn, std::string why, Timestamp now) {
  MissionMemory& m = turn.memory;
  // An approval on its way must be withdrawn; one that the vehicle refused is nowhere.
  const bool withdraw = m.status.state == MissionState::kApproved &&
                        m.status.approval_phase != MissionStatus::ApprovalPhase::kRefused;
  std::string ended = words::SelectionEnded(words::SiteName(m.status), why);
  Kill(turn, why);
  if (withdraw) {
    AskToHold(turn, words::Withdrawn(why), now);
  }
  ForgetSite(m);
  Enter(turn, MissionState::kProposed, std::move(why), now);
  m.status.selection_ended = std::move(ended);
}

void Hold(MissionTurn& turn, std::string why, Timestamp now) {
  Kill(turn, why);
  AskToHold(turn, why, now);
  turn.memory.winner = {};  // the next proposal must win fresh maps
  Enter(turn, MissionState::kHold, std::move(why), now);
}

void Abort(MissionTurn& turn, std::string why, Timestamp now) {
  MissionMemory& m = turn.memory;
  Kill(turn, why);
  m.wave_off_at = now;
  m.abort_id = RequestNumber(turn.station.session_id, ++m.requests_made);
  SendUntilAnswered(turn, AbortRequest{m.abort_id, why}, now);
  if (m.status.state == MissionState::kAborting) {
    return;  // pressed again: one more message, the same wave-off
  }
  m.abort_seen = m.wave_off_acknowledged = false;
  m.winner = {};
  Enter(turn, MissionState::kAborting, std::move(why), now);
}

}  // namespace palace
