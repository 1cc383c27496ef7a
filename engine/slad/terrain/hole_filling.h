// Hole filling: the thesis's Data Size and Border Size (Table 4.4). Internal to the SLAD room.
#pragma once

#include "engine/model/elevation_map.h"

namespace palace {

/// An unknown cell between two measured ones, in its row or its column, no more than
/// data_size_cells apart, takes the distance-weighted mean of the measured cells around it
/// (kFilled). Unknown cells outside the measured region, up to border_size_cells from it, take the
/// mean of their known neighbours ring by ring (kBorder). Larger holes stay unknown.
void FillHoles(ElevationMap& map, int data_size_cells, int border_size_cells);

}  // namespace palace
