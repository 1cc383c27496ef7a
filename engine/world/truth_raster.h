// Heights and flags of a world on a grid, seen straight from above: the first half of TruthOf
// (ground_truth.h).
#pragma once

#include "engine/world/ground_truth.h"

namespace palace {

/// Geometry, height_m and flags; the rest stays empty. A triangle is clipped to the square of every
/// cell that it touches, so that the highest point there is exact however thin the thing.
GroundTruth RasteriseWorld(const World& world, const TruthArea& area, double time_s);

}  // namespace palace
