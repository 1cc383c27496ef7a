#include "engine/survey/map_layers.h"

#include <cmath>

#include "engine/survey/hazard_layer.h"

namespace palace {
namespace {

GridF RootOf(const GridF& variance) {
  GridF sigma = variance;
  for (float& value : sigma.cells()) {
    value = std::sqrt(value);
  }
  return sigma;
}

}  // namespace

std::vector<DecidedLayer> LayersOf(const TerrainDecision& decision) {
  const ElevationMap& map = *decision.elevation;
  const HazardMaps& hazards = *decision.hazards;
  return {
      {"elevation", map.Measured()},
      {"elevation_sigma", RootOf(map.variance_m2)},
      {"slope", hazards.slope_rad},
      {"roughness", hazards.roughness_m},
      {"cost", hazards.cost},
      {"safe_distance", hazards.safe_distance_m},
      {"hazard", HazardLayer(map, hazards, decision.settings.mode)},
  };
}

}  // namespace palace
