// Transitions of the state machine that a step makes by itself, one function a state.
#pragma once

#include "engine/mission/transitions.h"

namespace palace {

void StepState(MissionTurn& turn, const MissionInputs& inputs);

}  // namespace palace
