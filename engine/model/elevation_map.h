// Elevation map: height of the ground per cell in the level frame, with its uncertainty.
#pragma once

#include <cstdint>

#include "engine/core/time.h"
#include "engine/model/grid.h"

namespace palace {

enum class CellState : std::uint8_t {
  kUnknown,   ///< never measured
  kMeasured,  ///< at least one range point fell into it
  kFilled,    ///< hole filled from neighbours; never safe in modern mode
  kBorder,    ///< rim filled by border_size_cells; never safe in modern mode
};

/// Heights are metres above the origin of W, up-positive. NaN where state is kUnknown.
struct ElevationMap {
  Timestamp time;
  GridGeometry geometry;
  GridF height_m;
  GridF variance_m2;
  Grid<std::uint16_t> frame_count;  ///< frames fused into the cell
  Grid<CellState> state;
};

}  // namespace palace
