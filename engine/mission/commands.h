// Commands: who may ask for what, and when.
#pragma once

#include "engine/mission/transitions.h"

namespace palace {

/// Does what is asked, or says why not (I22).
Status Obey(MissionTurn& turn, const EngineCommand& command, Timestamp now);

}  // namespace palace
