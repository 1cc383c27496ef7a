#include "engine/mission/commands.h"

#include <optional>
#include <utility>
#include <variant>

#include "engine/mission/going.h"
#include "engine/mission/obeying.h"
#include "engine/mission/permission.h"
#include "engine/mission/wave_off.h"
#include "engine/mission/wording.h"

namespace palace {

Status Refuse(MissionTurn& turn, Timestamp now, std::string_view what, std::string why) {
  AddEvent(turn, now, EventKind::kDecision, std::string(what) + kRefusedMark + why);
  return UsageError(std::move(why));
}

const char* WhoAsks(CommandOrigin origin) {
  return origin == CommandOrigin::kScript ? "a script" : "the operator";
}

Status Obeying::operator()(const FlyTo& there) const {
  if (std::string why = WhyNotThere(turn.memory, there, now); !why.empty()) {
    return Refuse(turn, now, "Fly there", std::move(why));
  }
  StartGoing(turn, there, WhoAsks(origin), now);
  return Ok();
}

Status Obeying::operator()(const SetFlyArea& action) const {
  MissionMemory& m = turn.memory;
  std::string why = IsFlying(m.status.state) ? words::kApprovedHold : WhyNoArea(action.area);
  if (why.empty() && m.status.going) {
    why = words::kOnAWay;
  }
  if (!why.empty()) {
    return Refuse(turn, now, "Area", std::move(why));
  }
  m.status.area = action.area;
  m.search.planned_at = {};
  AddEvent(turn, now, EventKind::kDecision,
           words::AreaSet(action.area, WhoAsks(origin), m.facts.p_WB));
  return Ok();
}

Status Obeying::operator()(const ClearFlyArea&) const {
  MissionMemory& m = turn.memory;
  if (!m.status.area) {
    return Refuse(turn, now, "Area", "None was drawn");
  }
  if (IsFlying(m.status.state)) {
    return Refuse(turn, now, "Area", words::kApprovedHold);
  }
  m.status.area.reset();
  m.search.planned_at = {};
  AddEvent(turn, now, EventKind::kDecision, std::string("Area cleared, by ") + WhoAsks(origin));
  return Ok();
}

Status Obeying::operator()(const HoldHere&) const {
  if (turn.memory.status.going) {
    StopGoing(turn, words::kHeldByOperator, now);
    return Ok();
  }
  if (!IsFlying(turn.memory.status.state)) {
    return Refuse(turn, now, "Hold", words::kNoDescent);
  }
  Hold(turn, words::kHeldByOperator, now);
  return Ok();
}

Status Obeying::operator()(const WaveOff&) const {
  if (const std::string why = WhyNoWaveOff(turn.memory, now); !why.empty()) {
    return Refuse(turn, now, "Wave-off", why);
  }
  Abort(turn, words::kWavedOff, now);
  return Ok();
}

Status Obeying::operator()(const AcknowledgeWaveOff&) const {
  if (turn.memory.status.state != MissionState::kAborting) {
    return Refuse(turn, now, "Acknowledge", words::kNoWaveOff);
  }
  turn.memory.wave_off_acknowledged = true;
  turn.memory.alarms.Acknowledge(AlarmId::kWaveOff);
  return Ok();
}

Status Obeying::operator()(const AcknowledgeAlarm& action) const {
  AlarmBoard& board = turn.memory.alarms;
  const std::optional<AlarmId> id = AlarmFromName(action.alarm);
  const std::string told = id ? board.LastText(*id) : std::string();
  if (!id || !board.Acknowledge(*id)) {
    return Refuse(turn, now, "Acknowledge", words::NotStanding(told));
  }
  AddEvent(turn, now, EventKind::kAlarm, words::Acknowledged(told));
  return Ok();
}

Status Obeying::operator()(const AddBookmark& action) const {
  AddEvent(turn, now, EventKind::kBookmark, action.note);
  return Ok();
}

Status Obeying::operator()(const AskForCommand& action) const {
  using Kind = SessionRequest::Kind;
  const AuthorityStatus& authority = turn.memory.facts.authority;
  if (!authority.can_ask && origin != CommandOrigin::kReplay) {
    return Refuse(turn, now, "Ask for command",
                  authority.commands() ? words::kCommandsAlready : authority.why_not);
  }
  AddEvent(turn, now, EventKind::kDecision, words::AskedForCommand(action, authority.holder));
  SessionRequest request;
  request.kind = action.take_over ? Kind::kTakeOver : Kind::kAsk;
  Send(turn, request);
  return Ok();
}

Status Obeying::operator()(const ReleaseCommand&) const {
  MissionMemory& m = turn.memory;
  if (IsFlying(m.status.state)) {
    return Refuse(turn, now, "Release command", words::kApprovedHold);
  }
  AddEvent(turn, now, EventKind::kDecision, words::kReleased);
  if (m.status.state == MissionState::kArmed) {
    Drop(turn, words::kReleased, now);
  }
  SessionRequest request;
  request.kind = SessionRequest::Kind::kRelease;
  Send(turn, request);
  return Ok();
}

Status Obeying::operator()(const CommandLost& action) const {
  const MissionState state = turn.memory.status.state;
  AddEvent(turn, now, EventKind::kVehicle, words::CommandLostTo(action.why));
  if (state == MissionState::kDescending) {
    Hold(turn, words::CommandLostTo(action.why), now);
  } else if (state == MissionState::kArmed || state == MissionState::kApproved) {
    Drop(turn, words::CommandLostTo(action.why), now);
  }
  turn.memory.status.going.reset();  // it is another's now
  return Ok();
}

Status Obey(MissionTurn& turn, const EngineCommand& command, Timestamp now) {
  std::string why_not = WhyNotAllowed(turn.station, turn.memory.facts, command);
  if (!why_not.empty()) {
    return Refuse(turn, now, "Command", std::move(why_not));
  }
  return std::visit(Obeying{turn, command.origin, now}, command.action);
}

}  // namespace palace
