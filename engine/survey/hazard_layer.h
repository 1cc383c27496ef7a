// The hazard layer of hazard.tif: what is wrong at each cell itself.
#pragma once

#include "engine/model/hazard_maps.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Per cell: 0 safe, 1 over a limit, NaN unknown. Filled holes count by their filled height, border
/// cells too in thesis mode. A footprint that would not fit does not count.
GridF HazardLayer(const ElevationMap& map, const HazardMaps& hazards, SladMode mode);

}  // namespace palace
