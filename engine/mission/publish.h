// The last part of a step: alarms, guards and geometry into the status that is published.
#pragma once

#include "engine/mission/transitions.h"

namespace palace {

void Publish(MissionTurn& turn, const MissionInputs& inputs);

}  // namespace palace
