// Ground truth: what a world's surface is like with everything that stands on it, and whether a
// disc of it is safe to land on.
//
// The world is cut into square cells (5 cm unless asked otherwise). The height of a cell is that of
// the ground at its middle, or of the highest point of whatever stands within its square where that
// is higher: a wire of 1 cm is in the truth, and so is what hangs over the ground. Over a disc
//
//   slope      angle of the least-squares plane  h = a + b north + c east  through its cells,
//   deviation  largest |height - plane|, holes as well as rocks,
//   step       largest difference of height between a cell of the disc and any cell whose middle is
//              at most kFootLength_m away, in the disc or beside it; not relative to the plane.
//
// Frames: W. Heights metres up-positive above its origin, places (north, east) metres, slopes
// degrees. Unknown: what lies outside of the grid is NaN, and no disc that reaches there is safe.
// The truth is of one moment (time_s): where moving things stand then. Softness of soil is not
// known; leaves and twigs count as they stand.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/grid.h"
#include "engine/world/world.h"

namespace palace {

inline constexpr double kFootLength_m = 0.15;
/// Side of the square whose least-squares plane is a place's slope.
inline constexpr double kSlopeWindow_m = 2.05;

/// Bits of GroundTruth::flags.
enum TruthFlag : std::uint8_t {
  kThingThere = 1,  ///< something stands there
  kMovingThere = 2,
  kSoftThere = 4,   ///< leaves and twigs
  kWaterThere = 8,  ///< open water, nothing on it
};

struct TruthArea {
  double north_min_m = -1;
  double north_max_m = 47;
  double east_min_m = -24;
  double east_max_m = 24;
  double cell_m = 0.05;
};

struct GroundTruth {
  GridGeometry geometry;
  GridF height_m;
  GridF step_m;     ///< of each cell to its neighbours within kFootLength_m
  GridF slope_deg;  ///< over kSlopeWindow_m; NaN near the rim
  Grid<std::uint8_t> flags;
};
GroundTruth TruthOf(const World& world, const TruthArea& area = {}, double time_s = 0);

struct DiscTruth {
  bool known = false;  ///< it lies on the grid; all else is NaN or 0 otherwise
  double slope_deg = std::numeric_limits<double>::quiet_NaN();
  double deviation_m = std::numeric_limits<double>::quiet_NaN();
  double step_m = std::numeric_limits<double>::quiet_NaN();
  double water_share = 0;
  double moving_share = 0;
};
/// Over the cells whose middles lie within the disc.
DiscTruth TruthOfDisc(const GroundTruth& truth, const Eigen::Vector2d& place_m, double radius_m);

struct TruthLimits {
  double slope_deg = 10;
  double deviation_m = 0.10;
  double step_m = 0.15;
  /// All of them but water and things that move, of which there must be none.
  TruthLimits Scaled(double factor) const {
    return {factor * slope_deg, factor * deviation_m, factor * step_m};
  }
};
bool WithinLimits(const DiscTruth& disc, const TruthLimits& limits);
bool SafeDisc(const GroundTruth& truth, const Eigen::Vector2d& place_m, double radius_m,
              const TruthLimits& limits);

struct TruthHazard {
  Eigen::Vector2d place_m;
  double distance_m = 0;
  const char* what = "";  ///< "step", "slope", "water" or "moving"
};
/// The nearest cell that breaks a limit by itself: its step, the slope around it, water, a thing
/// that moves. (A deviation belongs to a disc, not to a cell.) None: nothing on the grid does.
std::optional<TruthHazard> NearestHazard(const GroundTruth& truth, const Eigen::Vector2d& place_m,
                                         const TruthLimits& limits);

/// Where the middle of a safe disc may lie: a coarser grid over the same ground, 1 or 0.
struct SafePlaces {
  GridGeometry geometry;
  Grid<std::uint8_t> safe;
  int Count() const;
  /// Groups of places that touch, diagonally too.
  int Regions() const;
};
SafePlaces FindSafePlaces(const GroundTruth& truth, double radius_m, const TruthLimits& limits,
                          double every_m = 0.25);

}  // namespace palace
