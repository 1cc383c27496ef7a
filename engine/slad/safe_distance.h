// Exact Euclidean distance to the nearest cell that is a hazard.
//
// Two passes of one-dimensional distance transforms (Felzenszwalb & Huttenlocher 2012, Distance
// Transforms of Sampled Functions): linear in the number of cells, exact in squared cells.
#pragma once

#include <cstdint>

#include "engine/model/grid.h"

namespace palace {

/// `hazard` is 0 on safe cells. Distances run between cell centres, in metres, 0 on hazards. The
/// ring of cells just outside the map counts as hazard.
GridF SafeDistance(const Grid<std::uint8_t>& hazard, double cell_m);

}  // namespace palace
