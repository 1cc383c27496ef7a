// What a plain 3x3 pass over an elevation raster says: the figures of gdaldem, as yardstick.
//
//   slope      Horn 1981: gx = ((a + 2 d + g) - (c + 2 f + i)) / (8 cell), gy alike, atan |g|
//   roughness  largest less smallest of the nine heights
//
// An unknown neighbour takes the height of the cell itself, as `gdaldem -compute_edges` has it; so
// does one beyond the map, where gdaldem extrapolates. Unknown cells stay unknown. Checked against
// GDAL 3.6.2 in process on three lidar rasters: inside the rim roughness is equal, slope within
// 0.004 degrees.
#pragma once

#include "engine/model/grid.h"

namespace palace {

GridF PlainSlopeRad(const GridF& height_m, double cell_m);
GridF PlainRoughnessM(const GridF& height_m);

}  // namespace palace
