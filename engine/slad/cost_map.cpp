#include "engine/slad/cost_map.h"

#include <algorithm>
#include <cmath>

#include "engine/model/grid.h"

namespace palace {

float ProductCost(float slope_rad, float max_slope_rad, float roughness_m, float max_roughness_m) {
  if (std::isnan(slope_rad) || std::isnan(roughness_m)) {
    return kUnknownValue;
  }
  if (slope_rad > max_slope_rad || roughness_m > max_roughness_m) {
    return 1.0F;
  }
  return (roughness_m * slope_rad) / (max_roughness_m * max_slope_rad);
}

float MaximumCost(float slope_share, float roughness_share, float step_share) {
  if (std::isnan(slope_share) || std::isnan(roughness_share) || std::isnan(step_share)) {
    return kUnknownValue;
  }
  return std::min(1.0F, std::max({slope_share, roughness_share, step_share}));
}

}  // namespace palace
