// One limit moved over its usual range, on one map: verdicts and places for each value, all other
// limits as they are. What a preview of that value would show of the same map.
//
//   for each value   MeasureTerrain (once, where the limit asks nothing of it), JudgeTerrain,
//                    SiteRegistry::Select, which knows the places of the flight by their letters
//
// Even steps over the usual range, widened to the value in force; then, between two steps with
// another best place, halves, those nearest to that value first. Unknown ground is never safe area.
// Source: ours.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/model/limit_sweep.h"
#include "engine/model/terrain_decision.h"
#include "engine/slad/sites/site_selection.h"

namespace palace {

struct SweepRequest {
  const SettingInfo* limit = nullptr;               ///< MaySweep
  std::shared_ptr<const TerrainDecision> decision;  ///< of record: its map, its places
  Settings settings;                                ///< of all other limits
  SiteContext context;
  std::vector<std::uint64_t> refused;  ///< places that the operator refused: never the best
};

/// `goes_on` is asked before each value; false: the sweep comes back empty.
LimitSweep SweepLimit(const SweepRequest& request, const std::function<bool()>& goes_on);

}  // namespace palace
