#include "engine/survey/hazard_layer.h"

#include <cmath>
#include <cstddef>

namespace palace {

GridF HazardLayer(const ElevationMap& map, const HazardMaps& hazards, SladMode mode) {
  GridF layer(map.geometry.rows, map.geometry.cols, kUnknownValue);
  for (std::size_t i = 0; i < layer.cells().size(); ++i) {
    const CellState state = map.state.cells()[i];
    const bool known = state == CellState::kMeasured || state == CellState::kFilled ||
                       (state == CellState::kBorder && mode == SladMode::kThesis);
    const unsigned over = hazards.reasons.cells()[i] & ~unsigned{kHazardUnknown};
    // A flag needs no plane to say what it says.
    if (known && ((over & kHazardFlagged) != 0 || !std::isnan(hazards.slope_rad.cells()[i]))) {
      layer.cells()[i] = over != 0 ? 1.0F : 0.0F;
    }
  }
  return layer;
}

}  // namespace palace
