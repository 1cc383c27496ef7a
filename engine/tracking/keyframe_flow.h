// Keyframe flow: finds points of a keyframe again in the current picture.
//
// The keyframe is first warped into the current view by the predicted homography, which takes out
// scale, rotation and perspective; what remains is a small translation per point, found by
// pyramidal Lucas-Kanade (Bouguet 2001) and checked forwards and backwards (Kalal 2010). A
// homography through all points (RANSAC, Fischler & Bolles 1981) throws out those that move on
// their own.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct KeyframeFlowOptions {
  int window_px = 17;
  int pyramid_levels = 2;        ///< above the full picture: reaches about 30 px
  double max_return_px = 0.5;    ///< forwards-backwards distance
  double max_residual_px = 2.5;  ///< to the common homography
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  ///< added to every predicted pixel
};

struct FlowPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the current picture
  bool visible = false;                             ///< predicted inside the current picture
  bool found = false;                               ///< seen there, forwards and backwards
  bool agrees = false;                              ///< moves with the others
};

/// One FlowPoint per key pixel. Both pictures have one size.
std::vector<FlowPoint> FollowFromKeyframe(const ImageU8& keyframe, const ImageU8& current,
                                          const Eigen::Matrix3d& current_from_key,
                                          const std::vector<Eigen::Vector2d>& key_pixels,
                                          const KeyframeFlowOptions& options);

}  // namespace palace
