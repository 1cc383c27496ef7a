// Hazard maps: everything the safe landing area determination says about each cell.
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"
#include "engine/model/ground_class.h"

namespace palace {

/// Why a cell is not safe; bits, so that several may hold.
enum HazardReason : std::uint8_t {
  kHazardNone = 0,
  kHazardSlope = 1,
  kHazardRoughness = 2,
  kHazardStep = 4,
  kHazardUnknown = 8,       ///< unknown, filled or border (modern mode)
  kHazardProbability = 16,  ///< safe probability below the limit
  kHazardFlagged = 32,      ///< a flag that forbids landing (modern mode)
};

/// How many cells fell to what; each cell counted once, under its first reason in this order.
struct RejectedCells {
  int slope = 0;
  int roughness = 0;  ///< roughness or step
  int unknown = 0;
  /// Thin structure, no texture, motion, an unexplained mark that rather is a thing than chance; an
  /// elevated surface where those are avoided.
  int flagged = 0;
  int doubtful = 0;   ///< inside every limit as measured, but with too small a chance: noise
  int footprint = 0;  ///< no hazard, but too near one, or over a limit under the lander
};

/// Layers share the elevation map's geometry. NaN where unknown.
struct HazardMaps {
  GridGeometry geometry;
  GridF slope_rad;  ///< angle of the fitted plane's normal to the up vector
  GridF slope_sigma_rad;
  /// |height - plane| (thesis), or the largest sqrt(off^2 - (4 sigma)^2) of the measured cells off
  /// the cell's plane inside the footprint, 0 where noise explains them all.
  GridF roughness_m;
  GridF roughness_sigma_m;
  /// Inside the footprint the largest step between neighbours, less what the plane rises from one
  /// to the other and beyond 4 sigma of both; NaN in thesis mode.
  GridF step_m;
  GridF cost;             ///< 0 best .. 1 forbidden
  GridF safe_distance_m;  ///< to the nearest cell that is not safe; 0 on such a cell
  /// Of a safe touchdown of the lander's gear at its worst heading, and that nothing over the
  /// limits hides within the clear radius; NaN in thesis mode.
  GridF safe_probability;
  /// Rocks and holes over the limit expected unseen within the clear radius (hidden_things.h);
  /// empty: nothing is known of any (a survey, thesis mode).
  GridF hidden_things;
  Grid<std::uint8_t> reasons;  ///< HazardReason bits
  Grid<std::uint8_t> flags;    ///< TerrainFlag bits; empty in thesis mode
  Grid<GroundClass> ground;    ///< what each cell is to a lander
  RejectedCells rejected;
  GroundCounts counts;
  int safe_cells = 0;  ///< counts[kLandable]
};

inline bool CanBearLander(const HazardMaps& hazards, Cell cell) {
  return hazards.ground.at(cell) == GroundClass::kLandable;
}

/// What may hide within the clear radius; 0 where nobody asked (thesis mode, surveys).
inline double HiddenThingsAt(const HazardMaps& hazards, Cell cell) {
  return hazards.hidden_things.empty() ? 0.0 : static_cast<double>(hazards.hidden_things.at(cell));
}

}  // namespace palace
