#include "engine/model/mission/map_age.h"

namespace palace {

double MapAge(const EngineSnapshot& snapshot) {
  const TerrainDecision* shown = snapshot.terrain->Shown();
  return shown != nullptr ? SecondsBetween(shown->map_time, snapshot.time) : NAN;
}

bool IsMapOld(const EngineSnapshot& snapshot, double silent_s) {
  return MapAge(snapshot) + silent_s > kMapOld_s;
}

}  // namespace palace
