// Exact Euclidean distance to the nearest hazard.
//
// Two passes of one-dimensional distance transforms (Felzenszwalb & Huttenlocher 2012, Distance
// Transforms of Sampled Functions): linear in the number of cells, exact in squared cells. Towards
// a square the distance along each axis is max(0, |d| - 1/2) cells; the parabolas then stand on the
// sides of the cells instead of their middles.
#pragma once

#include <cstdint>

#include "engine/model/grid.h"

namespace palace {

/// What a distance runs to, always from the centre of a cell.
enum class DistanceTo {
  kCentre,  ///< of the hazard's cell (thesis mode)
  kSquare,  ///< nearest point of the hazard's cell: nothing measured in it is nearer
};

/// `hazard` is 0 on safe cells. Metres, 0 on hazards. The ring of cells just outside the map counts
/// as hazard.
GridF SafeDistance(const Grid<std::uint8_t>& hazard, double cell_m,
                   DistanceTo to = DistanceTo::kCentre);

}  // namespace palace
