// Age of the map that decisions rest on.
#pragma once

#include "engine/model/site_standing.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Older than this nothing may rest on a map: no approval (guard G4), no word on the screen.
inline constexpr double kMapOld_s = kOldGround_s;

/// Age of the map shown, by the data's clock; NaN without one.
double MapAge(const EngineSnapshot& snapshot);
/// There is a map, and it is too old for anything to rest on it; `silent_s` since the snapshot.
bool IsMapOld(const EngineSnapshot& snapshot, double silent_s = 0);

}  // namespace palace
