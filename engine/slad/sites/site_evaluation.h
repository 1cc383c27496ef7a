// The figures of one site on one map. Internal to the SLAD room.
#pragma once

#include "engine/slad/sites/approach_corridors.h"

namespace palace {

/// All fields of a site centred on the cell but id, letter and reason. The plane of the site is the
/// weighted least-squares plane of the known cells within the lander's radius, those more than
/// three sigmas and the roughness limit off it left out. `corridors`: of the same map and settings.
LandingSite EvaluateSite(const ElevationMap& map, const HazardMaps& hazards,
                         const SladSettings& settings, const SiteContext& context,
                         const ApproachCorridors& corridors, Cell cell);

}  // namespace palace
