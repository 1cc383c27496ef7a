// The name of a map.
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"

namespace palace {

/// What an approval binds: time, geometry, heights and verdicts.
std::uint64_t HashOfMaps(const ElevationMap& map, const HazardMaps& hazards);

}  // namespace palace
