// The figures of one site on one map. Internal to the SLAD room.
#pragma once

#include "engine/slad/site_selection.h"

namespace palace {

/// All fields of a site centred on the cell but id, letter and reason. The plane of the site is the
/// weighted least-squares plane of the known cells within the lander's radius, those more than
/// three sigmas and the roughness limit off it left out.
LandingSite EvaluateSite(const ElevationMap& map, const HazardMaps& hazards,
                         const SladSettings& settings, const SiteContext& context, Cell cell);

/// True when nothing known stands in the rotor-wide corridor that rises from the site along the
/// glide slope towards the vehicle. An object at distance s along it is met by the rim of a lander
/// whose centre is one lander radius nearer, so it may rise to (s - radius) tan(slope) above the
/// site, plus the roughness limit.
bool CorridorIsClear(const ElevationMap& map, const SladSettings& settings,
                     const SiteContext& context, const LandingSite& site);

}  // namespace palace
