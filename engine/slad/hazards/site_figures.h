// What the hazard maps say of a lander that is sent to a cell. Internal to the SLAD room.
#pragma once

#include "engine/model/hazard_maps.h"
#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// The figures of a lander sent to the cell: of its WorstTouchdown slope, roughness, step and safe
/// probability, of the cell itself distance, cost and what hides.
void TakeFigures(const HazardMaps& hazards, const SladSettings& settings, Cell cell,
                 LandingSite& site);

}  // namespace palace
