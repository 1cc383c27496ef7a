// Why no site was found on a map, in words. Internal to the SLAD room.
#pragma once

#include <string>

#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Shares of the cells by what they fell to: "71 % slope, 22 % unknown, 7 % too near a hazard"; and
/// the sizes where the map is too small for the lander, and what would tell lines from wires where
/// nothing did.
std::string NoneReason(const ElevationMap& map, const HazardMaps& hazards,
                       const SladSettings& settings);

}  // namespace palace
