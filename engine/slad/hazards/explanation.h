// Explanation: why a cell is safe or not.
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

namespace palace {

/// Terms against the settings the maps were judged under. Empty maps and cells outside give an
/// unknown cell without terms.
CellExplanation ExplainCell(const ElevationMap& map, const HazardMaps& hazards,
                            const SladSettings& settings, Cell cell);

}  // namespace palace
