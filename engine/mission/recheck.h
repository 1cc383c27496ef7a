// Re-checks of the armed site on every new map, and the alternative kept for it.
#pragma once

#include "engine/mission/transitions.h"

namespace palace {

/// Judges the armed site on this map; tells a changed verdict, and records re-checks of a descent.
void FollowSite(MissionTurn& turn, const MissionInputs& inputs);

}  // namespace palace
