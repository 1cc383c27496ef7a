#include "engine/survey/map_layers.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
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

MapPicture PictureOfLayer(const std::string& layer, const TerrainDecision& decision) {
  const SladSettings& slad = decision.settings;
  const std::vector<LandingSite>& sites = decision.selection.sites;
  if (layer == "elevation_sigma") {
    return {"elevation, one sigma, m", ColourTable::kInferno, 1, 0.0, {}};
  }
  if (layer == "slope") {
    return {"slope, deg", ColourTable::kMagma, kDegPerRad, 0.0, 2 * slad.limits.max_slope_deg};
  }
  if (layer == "roughness") {
    return {"roughness, m", ColourTable::kInferno, 1, 0.0, 2 * slad.limits.max_deviation_m};
  }
  if (layer == "cost") {
    return {"cost", ColourTable::kCividis, 1, 0.0, 1.0};
  }
  if (layer == "safe_distance") {
    const double most_m =
        sites.empty() ? slad.lander.clear_radius_m() : sites.front().safe_distance_m;
    return {"safe distance, m", ColourTable::kBlues, 1, 0.0, std::max(most_m, 0.1)};
  }
  if (layer == "hazard") {
    return {"hazard: 0 safe, 1 over a limit", ColourTable::kInferno, 1, 0.0, 1.3};
  }
  return {layer + ", m", ColourTable::kViridis, 1, {}, {}};
}

}  // namespace palace
