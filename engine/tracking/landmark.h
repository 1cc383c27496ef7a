// GroundLandmark: a point of the ground with a known place, seen in the present picture.
#pragma once

#include <Eigen/Dense>

namespace palace {

/// `pixel` is where the rectified left picture shows p_WF now; one standard deviation each.
struct GroundLandmark {
  Eigen::Vector3d p_WF = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 0;
  double sigma_w_m = 0;  ///< of p_WF, any direction
};

}  // namespace palace
