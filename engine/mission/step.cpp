#include "engine/mission/step.h"

#include <utility>

#include "engine/mission/arrivals.h"
#include "engine/mission/commands.h"
#include "engine/mission/geometry.h"
#include "engine/mission/going.h"
#include "engine/mission/publish.h"
#include "engine/mission/recheck.h"
#include "engine/mission/searching.h"
#include "engine/mission/states.h"
#include "engine/mission/transitions.h"

namespace palace {

MissionStep Step(const MissionOptions& station, MissionMemory memory, const MissionInputs& in) {
  MissionTurn turn{station, std::move(memory), {}};
  FollowJump(turn, in);
  turn.memory.watch.Update(in.vehicle.bundle, in.vehicle.channels, in.session.now);
  RememberEnergy(turn.memory, in);
  turn.memory.losses.Update(in.session.losses, in.vehicle.bundle.stereo != nullptr, in.session.now);
  RememberFacts(turn.memory, in);
  PlanApproach(turn.memory);
  FollowWinner(turn.memory, in);
  RememberGround(turn.memory, in);
  FollowSite(turn, in);
  FollowAuthority(turn, in);
  FollowAnswers(turn, in);
  FollowGoing(turn, in.session.now);
  StopDeadApproval(turn, in);
  StepState(turn, in);
  Repeat(turn, in.session.now);
  Publish(turn, in);
  PlanSearch(turn.memory, in.session.now);
  return {std::move(turn.memory), std::move(turn.effects)};
}

MissionAnswer Apply(const MissionOptions& station, MissionMemory memory,
                    const EngineCommand& command, const MissionInputs::Session& session) {
  MissionTurn turn{station, std::move(memory), {}};
  HearSession(turn.memory.facts, session);
  Status status = Obey(turn, command, session.now);
  PublishBetweenSteps(turn, session.now);
  return {std::move(turn.memory), std::move(turn.effects), std::move(status)};
}

bool DropsWithSettings(const MissionStatus& status) {
  return status.state == MissionState::kArmed || status.state == MissionState::kApproved;
}

MissionStep DropApproval(const MissionOptions& station, MissionMemory memory,
                         std::string_view why) {
  MissionTurn turn{station, std::move(memory), {}};
  if (DropsWithSettings(turn.memory.status)) {
    Drop(turn, std::string(why), turn.memory.facts.now);
    PublishBetweenSteps(turn, turn.memory.facts.now);
  }
  return {std::move(turn.memory), std::move(turn.effects)};
}

}  // namespace palace
