// Dark dots on a bright board: where they are, to a few hundredths of a pixel.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct Dot {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();      ///< centroid of the dot's area, px
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the area; half an axis is 2 sigma
  double area_px = 0;                                    ///< full dark pixels it amounts to
};

/// Dark spots of about `window_px` / 2 across and less: elliptic, brighter all round, away from the
/// border. The picture is held against its local mean in a square of window_px, so that light may
/// be uneven. Pixel accuracy only. At most 5000; none from a picture that has more.
std::vector<Dot> FindDots(const ImageU8& picture, int window_px);

/// Centroid of the dot with weight 1 - grey / background, the background a plane fitted to the ring
/// round the dot: noise-limited, and unmoved by uneven light, which scales dot and board alike. The
/// window is an ellipse of the dot's shape. False when the window leaves the picture, the ring is
/// not bright, or the dot dissolves; the dot is then unchanged.
bool RefineDot(const ImageU8& picture, Dot& dot);

}  // namespace palace
