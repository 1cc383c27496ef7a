// Who may ask for what, before it is asked whether it can be done now: views only look, records are
// not commanded, scripts commit simulated vehicles only (DESIGN.md 8).
#pragma once

#include <string>

#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"
#include "engine/model/command.h"

namespace palace {

/// Why the origin of that command may not ask for it; empty when it may.
std::string WhyNotAllowed(const MissionOptions& station, const MissionFacts& facts,
                          const EngineCommand& command);

}  // namespace palace
