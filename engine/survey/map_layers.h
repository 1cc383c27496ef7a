// The layers of a decided map as they become files, the same for every verb that writes them.
//
//   elevation, elevation_sigma (m) · slope (rad) · roughness (m) · cost (0..1) · safe_distance (m)
//   · hazard (0 safe, 1 over a limit by itself, without footprint growth)
//
// SI units, NaN unknown.
#pragma once

#include <string>
#include <vector>

#include "engine/model/grid.h"
#include "engine/model/terrain_decision.h"
#include "engine/survey/map_pictures.h"

namespace palace {

struct DecidedLayer {
  std::string name;  ///< and that of its files
  GridF cells;
};

std::vector<DecidedLayer> LayersOf(const TerrainDecision& decision);

/// How a layer is shown to people; its bar ends at twice the limit where there is one.
MapPicture PictureOfLayer(const std::string& layer, const TerrainDecision& decision);

}  // namespace palace
