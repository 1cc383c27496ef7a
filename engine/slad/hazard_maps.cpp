#include "engine/slad/hazard_maps.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"
#include "engine/slad/cost_map.h"
#include "engine/slad/hazard_layers.h"
#include "engine/slad/plane_fit.h"
#include "engine/slad/safe_distance.h"

namespace palace {
namespace {

void CountCells(const SladSettings& settings, HazardMaps& hazards) {
  const float clear_m = static_cast<float>(settings.clear_radius_m());
  for (int r = 0; r < hazards.geometry.rows; ++r) {
    for (int c = 0; c < hazards.geometry.cols; ++c) {
      const unsigned reasons = hazards.reasons.at(r, c);
      if ((reasons & kHazardSlope) != 0) {
        ++hazards.rejected.slope;
      } else if ((reasons & (kHazardRoughness | kHazardStep)) != 0) {
        ++hazards.rejected.roughness;
      } else if ((reasons & kHazardUnknown) != 0) {
        ++hazards.rejected.unknown;
      } else if ((reasons & kHazardProbability) != 0) {
        ++hazards.rejected.roughness;
      } else if (hazards.safe_distance_m.at(r, c) < clear_m ||
                 !FootprintHolds(hazards, settings, {r, c})) {
        ++hazards.rejected.footprint;
      } else {
        ++hazards.safe_cells;
      }
    }
  }
}

}  // namespace

HazardMaps UnknownHazards(const GridGeometry& geometry) {
  const GridF unknown(geometry.rows, geometry.cols, kUnknownValue);
  HazardMaps hazards;
  hazards.geometry = geometry;
  hazards.slope_rad = hazards.slope_sigma_rad = unknown;
  hazards.roughness_m = hazards.roughness_sigma_m = unknown;
  hazards.step_m = hazards.cost = hazards.safe_probability = unknown;
  hazards.safe_distance_m = GridF(geometry.rows, geometry.cols, 0.0F);
  hazards.reasons = Grid<std::uint8_t>(geometry.rows, geometry.cols, kHazardNone);
  return hazards;
}

double SlopeOfGradient(double north_gradient, double east_gradient, const Eigen::Vector3d& up_W) {
  // Height h(n, e) has the upward normal (-dh/dn, -dh/de, -1) in north-east-down.
  const Eigen::Vector3d normal_W(-north_gradient, -east_gradient, -1);
  // atan2 keeps small angles exact where acos(n . u) rounds them away.
  return std::atan2(normal_W.cross(up_W).norm(), normal_W.dot(up_W));
}

bool FootprintHolds(const HazardMaps& hazards, const SladSettings& settings, Cell cell) {
  if (hazards.reasons.at(cell) != kHazardNone) {
    return false;
  }
  if (settings.mode == SladMode::kThesis) {
    return true;
  }
  return hazards.slope_rad.at(cell) <= static_cast<float>(Rad(settings.max_slope_deg)) &&
         hazards.roughness_m.at(cell) <= static_cast<float>(settings.max_deviation_m) &&
         hazards.step_m.at(cell) <= static_cast<float>(settings.max_step_m) &&
         hazards.safe_probability.at(cell) >= static_cast<float>(settings.min_safe_probability);
}

void EvaluateThesis(const ElevationMap& map, const SladSettings& settings, HazardMaps& hazards) {
  const double cell_m = map.geometry.cell_m;
  // Samples a rock's size apart: a rock then spoils few of the nine and LMedS rejects it.
  const int stride = std::clamp(static_cast<int>(settings.max_rock_size_m / cell_m), 1,
                                std::max(1, std::min(map.geometry.rows, map.geometry.cols) / 3));
  const PlaneMaps planes = FitThesisPlanes(map.height_m, cell_m, stride);
  const Eigen::Vector3d up_W = settings.up_W();
  const float max_slope = static_cast<float>(Rad(settings.max_slope_deg));
  const float max_roughness = static_cast<float>(settings.max_deviation_m);
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      std::uint8_t& reasons = hazards.reasons.at(r, c);
      if (std::isnan(planes.residual_m.at(r, c))) {
        reasons = kHazardUnknown;
        continue;
      }
      const float slope = static_cast<float>(
          SlopeOfGradient(static_cast<double>(planes.north_gradient.at(r, c)),
                          static_cast<double>(planes.east_gradient.at(r, c)), up_W));
      const float roughness = std::abs(planes.residual_m.at(r, c));
      hazards.slope_rad.at(r, c) = slope;
      hazards.roughness_m.at(r, c) = roughness;
      hazards.cost.at(r, c) = ProductCost(slope, max_slope, roughness, max_roughness);
      if (slope > max_slope) {
        reasons |= kHazardSlope;
      }
      if (roughness > max_roughness) {
        reasons |= kHazardRoughness;
      }
    }
  }
}

HazardMaps EvaluateHazards(const ElevationMap& map, const SladSettings& settings) {
  HazardMaps hazards = UnknownHazards(map.geometry);
  if (map.height_m.empty()) {
    return hazards;
  }
  PALACE_CHECK(map.height_m.rows() == map.geometry.rows && map.geometry.cell_m > 0,
               map.height_m.rows(), map.geometry.rows, map.geometry.cell_m);
  if (settings.mode == SladMode::kThesis) {
    EvaluateThesis(map, settings, hazards);
  } else {
    EvaluateModern(map, settings, hazards);
  }
  Grid<std::uint8_t> safe(map.geometry.rows, map.geometry.cols, 0);
  for (std::size_t i = 0; i < safe.cells().size(); ++i) {
    safe.cells()[i] = hazards.reasons.cells()[i] == kHazardNone ? 1 : 0;
  }
  hazards.safe_distance_m = SafeDistance(safe, map.geometry.cell_m);
  CountCells(settings, hazards);
  return hazards;
}

}  // namespace palace
