// Explanation: why a cell is safe or not, why a site has its rank.
//
// A cell counts under the first that holds: slope, roughness or step, unknown, flagged, safe
// probability (the order of RejectedCells); a cell that is no hazard itself counts under what its
// footprint breaks, else under the room to the nearest hazard. Nothing is decided here: the
// verdicts are those of the hazard maps, this says which figure made them.
#pragma once

#include <string>

#include "engine/model/cell_explanation.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/settings/settings.h"
#include "engine/slad/sites/site_selection.h"

namespace palace {

/// Terms against the settings the maps were judged under. Empty maps and cells outside give an
/// unknown cell without terms.
CellExplanation ExplainCell(const ElevationMap& map, const HazardMaps& hazards,
                            const SladSettings& settings, Cell cell);

/// Fills `reason` of every site, in the units of what decided: metres of clear radius, cost, or the
/// corridor. The first says what it has over the next, the others what they lack against the best.
/// "the best" and "the next" become letters in SiteRegistry::Select. With less than `tight_m`
/// beyond its clear radius a site ranks behind those that have more.
void GiveReasons(SiteRanking ranking, double tight_m, SiteSelection& selection);

}  // namespace palace
