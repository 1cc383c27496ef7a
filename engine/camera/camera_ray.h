// What back-projection and differentiated projection of a camera give.
#pragma once

#include <Eigen/Dense>

namespace palace {

/// A ray in F: origin at the projection centre, unit direction away from the camera.
struct CameraRay {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// A projection and its derivative.
struct ProjectionJacobian {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 3> dpixel_dp =
      Eigen::Matrix<double, 2, 3>::Zero();  ///< px per unit of F
};

}  // namespace palace
