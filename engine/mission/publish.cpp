#include "engine/mission/publish.h"

#include <optional>
#include <utility>
#include <vector>

#include "engine/mission/alarms/alarms.h"
#include "engine/mission/descent_limits.h"
#include "engine/mission/geometry.h"
#include "engine/mission/going.h"
#include "engine/mission/guards.h"
#include "engine/mission/wave_off.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

void PublishAlarms(MissionTurn& turn, const MissionInputs& in) {
  MissionMemory& m = turn.memory;
  m.alarms.Update(EvaluateAlarms(AlarmFactsAt(m, in)), in.session.now);
  for (const Alarm& alarm : m.alarms.raised()) {
    AddEvent(turn, in.session.now, alarm);
  }
  for (const Alarm& alarm : m.alarms.ended()) {
    AddEvent(turn, in.session.now, EventKind::kAlarm, words::AlarmOver(alarm, in.session.now));
  }
  m.status.alarms = m.alarms.Shown();
}

/// A wave-off and a hold are told with the command that brings them about; all else waits for the
/// next step.
void RaiseAtOnce(MissionTurn& turn, Timestamp now) {
  MissionMemory& m = turn.memory;
  AlarmFacts facts;
  facts.state = m.status.state;
  facts.why = m.status.why;
  facts.wave_off = WaveOffNow(m, now);
  facts.alternative = SiteLost(m, now) ? words::Alternative(m) : "";
  std::vector<AlarmCondition> conditions;
  for (AlarmCondition& condition : EvaluateAlarms(facts)) {
    if (condition.present &&
        (condition.id == AlarmId::kWaveOff || condition.id == AlarmId::kHold)) {
      conditions.push_back(std::move(condition));
    }
  }
  m.alarms.Update(conditions, now);
  for (const Alarm& alarm : m.alarms.raised()) {
    AddEvent(turn, now, alarm);
  }
}

std::string WhyNoApproval(const MissionMemory& m) {
  if (!MaySelect(m.facts.role)) {
    return FindGuard(m.status.guards, GuardId::kSource)->reason;
  }
  if (const char* why = WhyViewOnly(m.facts)) {
    return why;
  }
  if (IsFlying(m.status.state)) {
    return words::kAlreadyApproved;
  }
  if (m.status.state == MissionState::kArmed) {
    const GuardResult* failed = FirstFailure(m.status.guards);
    return failed != nullptr ? failed->reason : words::kSelectFirst;
  }
  // What would stop it with a site, too, is worth more than that none is selected.
  for (const GuardResult& guard : m.status.guards) {
    if (!m.status.armed && !guard.pass && guard.reason != words::kSelectFirst) {
      return guard.reason;
    }
  }
  return words::kSelectFirst;
}

void PublishSides(MissionMemory& m) {
  m.status.approach_sides.clear();
  for (const ApproachCourse& course : CoursesOpen(m)) {
    m.status.approach_sides.push_back(course.side);
  }
}

/// Drawn where the way to a site is.
void PublishWayElsewhere(MissionMemory& m) {
  if (m.status.going && m.facts.p_WB.allFinite()) {
    const Eigen::Vector3d &from_W = m.facts.p_WB, &to_W = m.status.going->p_WB;
    m.status.way_W = {from_W, {from_W.x(), from_W.y(), to_W.z()}, to_W};
  }
}

void PublishFigures(MissionMemory& m, Timestamp now) {
  const std::optional<FlightPath> path = PublishGeometry(m);
  PublishWayElsewhere(m);
  PublishSides(m);
  PublishHeadings(m);
  PublishLimits(m, path, now);
  m.status.wave_off = WaveOffNow(m, now);
  m.status.why_no_wave_off = WhyNoWaveOff(m, now);
  m.status.armed_now = m.newest;
  m.status.armed_verdict = m.site.VerdictAt(now);
  m.status.armed_why = m.site.reason();
  m.status.armed_confirmed = m.status.armed && m.armed.confirmed;
  if (m.status.approval_phase == MissionStatus::ApprovalPhase::kSent) {
    m.status.approval_answer_s = SecondsBetween(m.approved_at, now);
  }
}

void PublishGuards(MissionMemory& m, Timestamp now) {
  m.status.may_select = MaySelect(m.facts.role) && WhyViewOnly(m.facts) == nullptr;
  m.status.why_not_go = m.status.may_select ? WhyNowhere(m, now) : "No vehicle is commanded here";
  m.status.guards = EvaluateGuards(GuardInputsAt(m, now));
  m.status.can_approve =
      m.status.state == MissionState::kArmed && FirstFailure(m.status.guards) == nullptr;
  m.status.cannot_approve_reason = m.status.can_approve ? std::string() : WhyNoApproval(m);
}

}  // namespace

void Publish(MissionTurn& turn, const MissionInputs& in) {
  PublishFigures(turn.memory, in.session.now);
  PublishAlarms(turn, in);
  PublishGuards(turn.memory, in.session.now);
}

void PublishBetweenSteps(MissionTurn& turn, Timestamp now) {
  MissionMemory& m = turn.memory;
  PublishFigures(m, now);
  RaiseAtOnce(turn, now);
  m.status.alarms = m.alarms.Shown();
  PublishGuards(m, now);
}

}  // namespace palace
