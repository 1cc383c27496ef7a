// How well a range map agrees with known depths: the figures that tests and experiments report.
//
// Every figure is worthless without its coverage: a matcher that answers only where it is easy
// looks precise. Sources: the lock to whole pixels, Shimizu & Okutomi 2001; the rest by definition.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

inline constexpr std::size_t kFractionBins = 10;

struct DisparityAccuracy {
  double coverage = 0;    ///< known share of the pixels that both cameras see
  double outliers = 0;    ///< share of the known ones that are off by more than 1 px
  double rms_px = 0;      ///< of errors up to 1 px
  double lock_px = 0;     ///< largest |mean error| over bins of the true fraction with 500 pixels
  double normalised = 0;  ///< standard deviation of error / sigma; NaN without sigmas
  std::array<double, kFractionBins> mean_error_px{};  ///< by fraction; NaN below 500 pixels
};

/// `sigma_px` may be empty. Pixels that the right picture does not hold (8 px margin) do not count.
DisparityAccuracy CompareDisparity(const ImageF& disparity_px, const ImageF& sigma_px,
                                   const ImageF& true_disparity_px);

/// f b / depth; NaN stays NaN, infinite depth gives 0.
ImageF DisparityFromDepth(const ImageF& depth_m, double fb_px_m);

/// Measured and true depths of the camera at X_WC. True places select pixels, measured ones count.
struct MeasuredView {
  PinholeCamera camera;
  RigidTransform X_WC;
  const ImageF& depth_m;
  const ImageF& true_depth_m;
};

/// Level rectangle, sides along north and east.
struct Patch {
  double north_m = 0;
  double east_m = 0;
  double size_north_m = 0;
  double size_east_m = 0;
};

/// Mean measured height of the top of a box `height_m` high standing on `footprint`, 5 cm inside
/// its edges, over that of the level ground 0.25 to 0.85 m outside them. NaN without 5 pixels of
/// each.
double MeasuredHeight(const MeasuredView& view, const Patch& footprint, double height_m);

/// A plane h = a + b north + c east through measured points, by least squares.
struct PatchSlope {
  double slope_rad = 0;  ///< angle of the plane to the level
  double error_rad = 0;  ///< angle between it and the plane through the true points
  double known = 0;      ///< share of the patch's pixels
};
/// NaN where fewer than 20 pixels are known.
PatchSlope MeasureSlope(const MeasuredView& view, const Patch& patch);

/// Slopes over all square patches of `size_m` that lie side by side in what both cameras see and
/// are at least 80 % known.
std::vector<PatchSlope> SlopesOverGround(const MeasuredView& view, double baseline_m,
                                         double size_m);

}  // namespace palace
