// Monocular position: where the camera is, from one tracked pixel, the attitude and the laser.
//
// Hintze 2004, equations 3.1-3.12 and the seven steps of 3.2.3, with the errata of the reference
// corrected: f = (W/2) / tan(FoV/2) (E1), pixel relative to the principal point and undistorted
// (E4), Z_CF a depth (E5), Theta_C negative downwards (E6), P_camera = P_site - P_IF (E8), lever
// arm to the body's reference point (E9), guards (E11).
//   Z_IC = -(sin th cos tc + cos ph cos th sin tc) Z_CC                                 (3.8)
//   D1 = cos tc + y/f sin tc,  D2 = x/f,  D3 = -sin tc + y/f cos tc                     (3.10)
//   Z_CF = Z_IC / (S31 D1 + S32 D2 + S33 D3)                                            (3.12)
// Assumes the feature lies at the height of the laser's spot (assumption 1).
#pragma once

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/result.h"

namespace palace {

/// Focal length in pixels of a picture `width_px` wide that sees `fov_rad` edge to edge (3.1, E1).
double FocalFromFieldOfView(double width_px, double fov_rad);

struct MonocularInput {
  EulerAngles attitude;  ///< of the body, true north (E10)
  double tilt_rad = 0;   ///< Theta_C, negative down
  double focal_x_px = 0;
  double focal_y_px = 0;                            ///< equal to focal_x_px for square pixels (E3)
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< from the principal point, right and down
  double laser_m = 0;                               ///< Z_CC, along the optical axis
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();   ///< the tracked site, NED
};

struct MonocularPosition {
  double Z_IC_m = 0;  ///< height of the camera above the feature's plane
  double Z_CF_m = 0;  ///< depth of the feature along the optical axis
  Eigen::Vector3d P_CF = Eigen::Vector3d::Zero();  ///< feature in camera axes
  Eigen::Vector3d P_IF = Eigen::Vector3d::Zero();  ///< camera to feature in NED axes
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();  ///< camera in W
};

/// Invalid when an input is not finite, the laser sees no ground below (Z_IC <= 0), or the ray is
/// near the horizon (denominator of 3.12 <= 0.1).
Result<MonocularPosition> PositionFromPixel(const MonocularInput& input);

/// Body reference point from the camera's (E9): P_CG = P_camera - R_WB r, r the camera in B.
Eigen::Vector3d BodyFromCamera(const Eigen::Vector3d& p_WC, const EulerAngles& attitude,
                               const Eigen::Vector3d& camera_in_body_m);

}  // namespace palace
