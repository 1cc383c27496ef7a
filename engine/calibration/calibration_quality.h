// How good a calibration is, and which view would make it better.
//
// Maps lie over the picture: equal rectangles, row 0 at the top, NaN unknown.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/calibration/calibration.h"
#include "engine/model/grid.h"

namespace palace {

/// Cells of the maps that a person sees, and that NextView speaks of.
inline constexpr int kMapColumns = 15;
inline constexpr int kMapRows = 12;

/// One sentence for every view of which a picture has more than a quarter of its points taken out
/// as outliers: such a picture shows another board position than its partner or than was fitted,
/// and must not pass as a few bad points. Empty when all pictures agree.
std::vector<std::string> Contradictions(const Calibration& calibration);

/// Number of points that fell into each cell. side: 0 left, 1 right.
GridF CoverageMap(const Calibration& calibration, int side, int rows, int columns);

/// One sigma in pixels of where a far, known direction appears, from the parameters' covariance.
/// A small common rotation of the camera is taken out first: it moves the mounting, not the lens,
/// and exchanges with hc and vc. The larger axis of the 2 x 2 covariance is given.
GridF UncertaintyMap(const Calibration& calibration, int side, int rows, int columns);

/// One sigma in metres of the depth of a point at depth_m in front of the pixel's cell of the left
/// camera, from the parameters' covariance alone (no matching error); NaN where the right camera
/// does not see it.
GridF DepthSigmaMap(const Calibration& calibration, double depth_m, int rows, int columns);

/// Row difference of the same point in both pictures after AlignPair, all points seen by both.
struct EpipolarCheck {
  int points = 0;
  double rms_px = 0;  ///< NaN without points
  double max_px = 0;
  double held_out_rms_px = 0;  ///< with cameras that never saw the views; NaN without them
};
EpipolarCheck CheckEpipolar(const Calibration& calibration);

/// What a person should do next, in one or two sentences: where in the picture to hold the board,
/// at which tilt, or that nothing is lacking. Its figures are those of CoverageMap and
/// UncertaintyMap with kMapRows x kMapColumns cells.
std::string NextView(const Calibration& calibration);

}  // namespace palace
