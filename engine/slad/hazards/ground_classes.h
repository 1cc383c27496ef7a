// What each cell is to a lander that is sent there. Internal to the SLAD room.
//
// A lander sent to a cell touches down within nav_error_m of it. The room is asked of the cell, for
// the clear radius holds the navigation error already; the limits under the lander (slope,
// roughness, step, probability of a safe touchdown) are asked of every touchdown. What may hide is
// counted within the clear radius of the cell, so no touchdown is asked for more of it.
// Source: ours.
#pragma once

#include "engine/model/hazard_maps.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Gives every cell its class, and counts. Needs all other layers of the maps. Rows are shared
/// among OpenCV's threads; their number changes no bit.
void ClassifyCells(const SladSettings& settings, HazardMaps& hazards);

/// The touchdown whose figures speak for a lander sent to the cell: the cell itself, or, where only
/// another within nav_error_m of it breaks a limit (GroundClass::kFootprint), the nearest such; of
/// equally near ones the northernmost, then westernmost.
Cell WorstTouchdown(const HazardMaps& hazards, const SladSettings& settings, Cell cell);

}  // namespace palace
