// Plane fits: the thesis's 3x3 LMedS then least squares, and modern mode's footprint plane.
//
// LMedS (Rousseeuw 1984) minimises the median squared residual over all planes through three of
// the nine points: 84 triples, 76 of them not collinear. Each fits its own three points, so the
// median of nine (the 5th smallest) is the 2nd smallest of the other six. The residual of point m
// off the plane of (i,j,k) is D(i,j,k,m) / A(i,j,k) with |D| symmetric in its four points: 126
// values serve all 504 residuals. Inliers within 2.5 robust sigmas are refitted by least squares.
// With n < 9 known samples the median is the (n/2 + 1)-th smallest; below six of them every
// triple's is 0, so all known samples are refitted.
#pragma once

#include "engine/model/elevation_map.h"
#include "engine/model/grid.h"

namespace palace {

struct SladLoops;

/// Planes per cell: height_m at the cell's centre and its gradient, metres per metre towards north
/// and east. NaN where fewer than three points that span a plane are known.
struct PlaneMaps {
  GridF height_m;
  GridF residual_m;  ///< height of the cell less the plane's; NaN where either is unknown
  GridF north_gradient;
  GridF east_gradient;
};

/// Exact LMedS and least squares over the 3x3 samples `stride` cells apart around each cell.
/// Unknown neighbours, and those outside the map, are left out; the median is then over those that
/// remain. Rows are shared among OpenCV's threads; their number, and which `loops` run (null: the
/// fastest), change no bit.
PlaneMaps FitThesisPlanes(const GridF& height_m, double cell_m, int stride,
                          const SladLoops* loops = nullptr);

/// Robust weighted least-squares plane of the ground over the footprint around each cell.
struct FootprintPlanes {
  PlaneMaps plane;
  GridF gradient_sigma;    ///< of the slope tangent along the steepest direction
  GridF cell_variance_m2;  ///< mean height variance of the cells in the window
};

/// Window: the square with the area of the footprint circle, at least 5x5 cells: of nine, some of
/// them unknown, no robust fit can tell an outlier from a slope. Weights are
/// inverse variances; three passes of summed-area moments, between which cells that stand off their
/// own plane are rejected, upwards sooner than downwards because obstacles stand on ground.
/// Cells with kFlagElevated in `flags` (empty: none) take no part in the planes of the others.
FootprintPlanes FitFootprintPlanes(const ElevationMap& map, double footprint_diameter_m,
                                   const Grid<std::uint8_t>& flags = {});

}  // namespace palace
