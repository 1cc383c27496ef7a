// Small pieces of ground for the experiment on touchdown probability: known exactly, and as a map
// of ten fused stereo frames would show them.
//
// The ground is known at a third of a map cell. A map cell is the mean of its nine points plus
// noise, shared by neighbouring cells as that of stereo windows is.
#pragma once

#include <array>
#include <cstdint>

#include "engine/model/elevation_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// What stands on the ground, sizes drawn around the lander's limits.
enum class GroundKind : int { kFlat, kSlope, kWaves, kRocks, kSteps, kMounds, kMixed };
inline constexpr std::array kGroundKindNames = {"flat",  "slope",  "waves", "rocks",
                                                "steps", "mounds", "mixed"};

inline constexpr int kPointsPerCell = 3;

struct TouchdownField {
  GridF height_m;  ///< true, kPointsPerCell points a cell both ways
  ElevationMap map;
  double sigma_m = 0;  ///< of a cell's height, as added; the map declares it within 15 %
};

/// `side` cells of settings.cell_m square, the same for the same seed.
TouchdownField MakeTouchdownField(GroundKind kind, const SladSettings& settings, int side,
                                  std::uint64_t seed);

/// The true figures of a touchdown with its middle on a cell, from the noise-free points.
struct TrueTouchdown {
  double slope_rad = 0;    ///< of the ground plane of the footprint
  double deviation_m = 0;  ///< largest off that plane over the footprint
  double step_m = 0;       ///< largest between points a map cell apart, less what the plane rises
  double tilt_rad = 0;     ///< of the gear, at its worst heading
  double rise_m = 0;       ///< of the ground under the belly, at its worst heading

  bool Safe(const SladSettings& settings) const;
};

/// By the definitions of hazard_maps.h and touchdown.h, worked out slowly: planes from all points,
/// resting pitches by search, headings and points three times as dense. The lander's footprint must
/// lie on the field.
TrueTouchdown FindTrueTouchdown(const TouchdownField& field, const SladSettings& settings,
                                Cell cell);

}  // namespace palace
