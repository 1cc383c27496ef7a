// The last part of a step: alarms, guards and geometry into the status that is published.
#pragma once

#include "engine/mission/transitions.h"

namespace palace {

void Publish(MissionTurn& turn, const MissionInputs& inputs);
/// After a command: the same figures and guards of the new state, by what the last step knew.
/// Alarms are judged in steps only; what was acknowledged is told at once.
void PublishBetweenSteps(MissionTurn& turn, Timestamp now);

}  // namespace palace
