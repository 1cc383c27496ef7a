// Disparity of level ground at a pixel of the rectified left picture.
//
//   d = f b / Z,  1/Z = ((R_WC r) . down) / h     r = the pixel's ray of unit depth,
//                                                 h = the camera's height over the ground, metres
#pragma once

#include <algorithm>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/rig.h"

namespace palace {

/// Share of the level ground's disparity down to which ground is looked for: it may fall away by a
/// twelfth of the range.
inline constexpr double kFallsAway = 0.92;

class GroundDisparity {
 public:
  /// `X_WC`: pose of the rectified left camera; `ground_height_m`: above the origin of W,
  /// up-positive. A camera nearer than 0.3 m is taken as standing on its skids, 0.3 m high.
  GroundDisparity(const PinholeCamera& camera, double baseline_m, const RigidTransform& X_WC,
                  double ground_height_m);
  /// Pixels; 0 at and above the horizon.
  double At(double x_px, double y_px) const {
    return std::max(0.0, of_pixel_.x() * x_px + of_pixel_.y() * y_px + of_pixel_.z());
  }
  double height_m() const { return height_m_; }

 private:
  Eigen::Vector3d of_pixel_;  ///< d = of_pixel_ . (x, y, 1)
  double height_m_;
};

}  // namespace palace
