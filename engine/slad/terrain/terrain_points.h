// Points of the ground in W and the grid they are re-sampled into. Internal to the SLAD room.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

struct TerrainPoint {
  double north_m = 0;
  double east_m = 0;
  double height_m = 0;     ///< up-positive
  double variance_m2 = 0;  ///< of the height; 0 when the source gives no noise figure
};
using TerrainPoints = std::vector<TerrainPoint>;

/// Rectangle of the ground.
struct GroundBounds {
  double north_min_m = 0;
  double north_max_m = 0;
  double east_min_m = 0;
  double east_max_m = 0;
};

/// In W, of every `stride_px`-th pixel each way; the range map has a pose.
TerrainPoints PointsFromRange(const RangeMap& range, int stride_px = 1);

/// 1st to 99th percentile of the points. Zeros when there are none.
GroundBounds BoundsOfData(const TerrainPoints& points);
/// Thesis 4.4 with the field of view and the tilt: where the picture's corners meet the level plane
/// at the median height, no farther than twice the mean range. `view`: from where, with its pose.
GroundBounds BoundsOfView(const TerrainPoints& points, const RangeMap& view);
/// The bounds the settings ask for. `view`: that of the points, with its pose; null for a cloud.
GroundBounds ChooseBounds(const TerrainPoints& points, const SladSettings& settings,
                          const RangeMap* view);
/// The grid that settings lay over the bounds.
GridGeometry LayOutGrid(const GroundBounds& bounds, const SladSettings& settings);

/// Heights and variances per cell. The height is the points' mean; where points that state their
/// noise spread by more than it and an ordinary slope explain, as over the side of an obstacle, the
/// standard deviation of that relief is added, so that what stands in the cell is not averaged away
/// and does not pass for noise. `correlated_points`: how many neighbouring points share one error,
/// as stereo's matching windows overlap; 1 for independent points.
ElevationMap AccumulateCells(const TerrainPoints& points, const GridGeometry& geometry,
                             SladMode mode, double correlated_points, Timestamp time);

/// Neighbouring pixels of a range map that share one error: windows of 9 pixels overlap heavily.
inline constexpr double kCorrelatedPixels = 16;

}  // namespace palace
