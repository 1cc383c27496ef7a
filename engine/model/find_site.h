// A landing site by its id.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/model/terrain_decision.h"

namespace palace {

/// Null where no site of the list has that id. The result points into the list.
inline const LandingSite* FindSite(const std::vector<LandingSite>& sites, std::uint64_t id) {
  const auto found = std::find_if(sites.begin(), sites.end(),
                                  [&](const LandingSite& site) { return site.id == id; });
  return found != sites.end() ? &*found : nullptr;
}

/// The same of a map's sites; null without a map.
inline const LandingSite* FindSite(const TerrainDecision* map, std::uint64_t id) {
  return map != nullptr ? FindSite(map->selection.sites, id) : nullptr;
}

}  // namespace palace
