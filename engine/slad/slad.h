// Safe landing area determination (thesis 4.3): the calls in order.
//
//   TerrainFusion::Add        range map, X_WC      -> elevation map
//   MeasureTerrain            elevation map        -> planes, deviations, sigmas: no limit asked
//   JudgeTerrain              those, limits        -> hazard, cost and safe-distance maps
//   EvaluateHazards           both in one
//   SelectSites               maps, vehicle        -> ranked sites
//   SiteRegistry::Assign      sites                -> ids and letters
//   VerdictImage              range map, hazards   -> overlay for the left picture
//   HashOfMaps                maps                 -> what an approval binds
#pragma once

#include <cstdint>

#include "engine/slad/hazards/hazard_maps.h"
#include "engine/slad/sites/site_selection.h"
#include "engine/slad/sites/verdict_image.h"
#include "engine/slad/terrain/elevation_map_builder.h"
#include "engine/slad/terrain/fusion.h"

namespace palace {

/// Names the map an approval was given on: geometry, heights and verdicts.
std::uint64_t HashOfMaps(const ElevationMap& map, const HazardMaps& hazards);

}  // namespace palace
