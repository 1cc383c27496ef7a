// Elevation map of one range map or one point cloud: heights re-sampled into a level grid.
//
//   z(r,c) = sum(z_i / s_i^2) / sum(1 / s_i^2)  over the points i that fall into the cell
//
// Rotating by the pose X_WC removes the tilt of the camera and the perspective (thesis 4.3.1). A
// point's height sigma s_i is its depth sigma projected on the vertical. Thesis mode: plain mean.
// Cells without a point are NaN (kUnknown); small holes are kFilled, the outer rim kBorder.
//
// Grid: thesis mode lays grid_rows x grid_cols over the bounds with one square cell size; modern
// mode keeps cell_m and centres grid_rows x grid_cols on the bounds, snapped to whole cells of one
// lattice fixed in W. Bounds of the data are the 1st and 99th percentile: one stray match must not
// stretch the map. Under kGiven they are metres from the median point. Under kFieldOfView they are
// thesis 4.4, 4.5 with f the field of view and the tilt accounted for (errata E19, E20); a cloud
// has no field of view and takes its data bounds instead. No points give an all-unknown map.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// A perfect point's weight stays finite: variances below (1 mm)^2 count alike.
inline constexpr double kLeastPointVariance_m2 = 1e-6;
/// What ground of ordinary slope spreads inside a cell by, in cells, one standard deviation,
/// without being noise.
inline constexpr double kSlopeSpread_cells = 0.1;

/// The range map has a pose, in the level frame W (north-east-down, metres).
ElevationMap ElevationFromRange(const RangeMap& range, const SladSettings& settings);

/// p_W: points in W, metres; points with a NaN are ignored. sigma_m: height sigma of each point,
/// same length, or null for points without noise figure (a survey).
ElevationMap ElevationFromPoints(const std::vector<Eigen::Vector3d>& p_W,
                                 const std::vector<float>* sigma_m, const SladSettings& settings,
                                 Timestamp time);

}  // namespace palace
