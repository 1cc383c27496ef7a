// What the hazard maps say before any limit is asked: planes, deviations, steps and their sigmas.
// Measuring costs nearly all the time; a moved limit needs only JudgeTerrain (hazard_maps.h).
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"
#include "engine/model/settings.h"

namespace palace {

/// Layers share the elevation map's geometry; NaN where unknown. Those of modern mode are empty in
/// thesis mode.
struct TerrainFigures {
  // The settings they depend on.
  SladMode mode = SladMode::kModern;
  double max_rock_size_m = 0;
  double lander_base_size_m = 0;
  LandingGear gear = LandingGear::kSkids;
  double gear_length_m = 0;
  double gear_width_m = 0;
  double up_tilt_deg = 0, up_azimuth_deg = 0;  ///< the gear's worst heading depends on it

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

  /// Whether measuring again under these settings would give the same figures.
  bool HoldFor(const SladSettings& settings) const {
    const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
    return mode == settings.mode && same(max_rock_size_m, settings.max_rock_size_m) &&
           (mode == SladMode::kThesis ||
            (same(lander_base_size_m, settings.lander_base_size_m) && gear == settings.gear &&
             same(gear_length_m, settings.gear_length_m) &&
             same(gear_width_m, settings.gear_width_m) && same(up_tilt_deg, settings.up_tilt_deg) &&
             same(up_azimuth_deg, settings.up_azimuth_deg)));
  }
};

/// Works on any size of map, also empty or all unknown.
TerrainFigures MeasureTerrain(const ElevationMap& map, const SladSettings& settings);

}  // namespace palace
