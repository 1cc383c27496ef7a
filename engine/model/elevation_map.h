// Elevation map: height of the ground per cell in the level frame, with its uncertainty.
#pragma once

#include <cstdint>

#include "engine/core/time.h"
#include "engine/model/grid.h"
#include "engine/model/view_pose.h"

namespace palace {

enum class CellState : std::uint8_t {
  kUnknown,   ///< never measured
  kMeasured,  ///< at least one range point fell into it
  kFilled,    ///< hole filled from neighbours; never safe in modern mode
  kBorder,    ///< rim filled by border_size_cells; never safe in modern mode
};

/// What pictures and motion say about a cell, bits.
enum TerrainFlag : std::uint8_t {
  kFlagNone = 0,
  kFlagThinStructure = 1,  ///< a line above the ground seen in the picture: wire, rope, mast
  kFlagNoTexture = 2,      ///< large and without texture: water, glass, bare snow
  kFlagShadow = 4,         ///< deep shadow: little is seen there
  kFlagMotion = 8,         ///< moved between frames
  kFlagElevated = 16,      ///< flat top raised above its surroundings: roof, table, vehicle
  /// The two pictures differ there by what no height of the ground explains: a thing may stand.
  kFlagUnexplained = 32,
};

/// What the pictures show of narrow things, and what one would show, at places half a cell apart:
/// place (i, j) lies in cell (i / 2, j / 2). NaN where nothing can be said. fine_relief.h measures
/// them, hidden_things.h draws the conclusion.
struct NarrowFigures {
  static constexpr int kPerCell = 2;  ///< places along a cell

  GridF prominence_m;  ///< of a square about the place above the ground around
  GridF noise_m;       ///< its sigma by the pictures' noise
  GridF sigma_m;       ///< its sigma, with bumps around
  GridF share;         ///< of its height that a thing 18 cm across shows in the square
  double ring_m = 0;   ///< how far the ground around reaches from the place
  /// Chance that the pictures differ there by what no height of the ground explains, and the least
  /// height of a thing that would make them differ so (unexplained.h). Empty: not asked.
  GridF mark{};
  GridF mark_from_m{};

  bool empty() const { return prominence_m.empty(); }
};

/// Heights are metres above the origin of W, up-positive. NaN where state is kUnknown.
///
/// Two heights a cell: the ground as measured, and over it the top of what stands or may stand
/// there by the evidence (relief inside a cell, between frames, narrower than stereo's window).
/// What is shown, exported, flown to or held against the laser is Measured(); hazards, planes and
/// the corridor are asked of the top.
struct ElevationMap {
  Timestamp time;
  GridGeometry geometry;
  GridF height_m;  ///< top; never below what was measured
  GridF variance_m2;
  Grid<std::uint16_t> frame_count;  ///< frames fused into the cell
  Grid<CellState> state;
  GridF measured_m{};          ///< ground as measured; empty: the same as height_m
  GridF age_s{};               ///< since the cell was last measured; empty: all of one frame
  Grid<std::uint8_t> flags{};  ///< TerrainFlag bits; empty: none
  /// Of the thin structure above the cell, which its flag tells of; infinite where its height is
  /// unknown, NaN where there is none. Empty: none. No part of height_m: nothing stands below a
  /// wire.
  GridF thin_top_m{};
  /// How far up over the cell the cameras have looked, above the origin of W; NaN: never. Empty:
  /// not asked (a survey, thesis mode).
  GridF air_seen_to_m{};
  NarrowFigures narrow{};  ///< empty: not asked (a survey, thesis mode)
  /// Of the newest pose the heights were taken from: the slope of everything is off by this much.
  double attitude_sigma_rad = PoseSigmas{}.attitude_rad;

  const GridF& Measured() const { return measured_m.empty() ? height_m : measured_m; }
};

}  // namespace palace
