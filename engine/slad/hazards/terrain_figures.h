// What the hazard maps say before any limit is asked: planes, deviations, steps and their sigmas.
// Measuring costs nearly all the time; a moved limit needs only JudgeTerrain (hazard_maps.h).
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Layers share the elevation map's geometry; NaN where unknown. Those of modern mode are empty in
/// thesis mode.
struct TerrainFigures {
  SladMode mode = SladMode::kModern;  ///< and lander: what they were measured for
  Lander lander;

  GridF north_gradient;  ///< of the plane, metres per metre
  GridF east_gradient;
  GridF deviation_m;  ///< of the cell from its plane; in modern mode beyond its noise

  // Modern mode.
  Grid<std::uint8_t> flags;  ///< of the map, and kFlagElevated; empty: none
  GridF step_m;              ///< at the cell that makes it, beyond noise
  GridF sigma_m;             ///< of the cell's deviation, a rock's size averaged
  GridF slope_sigma_rad;
  GridF footprint_deviation_m;  ///< largest over the lander's disc, beyond noise
  GridF footprint_step_m;
  GridF footprint_sigma_m;      ///< mean over the disc, a rock's size averaged
  GridF denoised_deviation_m;   ///< largest over the disc of the denoised heights
  GridF gear_tilt_rad;          ///< of the gear on the denoised heights, at its worst heading
  GridF belly_rise_m;           ///< of denoised heights under the belly above the gear's plane
  Grid<std::uint8_t> measured;  ///< 1 where the cell itself was measured
  NarrowFigures narrow;         ///< of the map

  /// Whether measuring again under these settings would give the same figures.
  bool HoldFor(const SladSettings& settings) const;
};

/// Works on any size of map, also empty or all unknown.
TerrainFigures MeasureTerrain(const ElevationMap& map, const SladSettings& settings);

}  // namespace palace
