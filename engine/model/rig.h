// The stereo rig: two cameras, their mount on the airframe, and the disparity window.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/frames.h"

namespace palace {

/// Undistorted pinhole. x_px = fx X/Z + cx, y_px = fy Y/Z + cy, camera axes right-down-forward.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;  ///< principal point; (width-1)/2 for a centred one
  double cy_px = 0;
  friend bool operator==(const PinholeCamera&, const PinholeCamera&) = default;
};

/// JPL CAHVOR model (Yakimovsky & Cunningham 1978; Gennery 2006). O = A and R = 0 make it CAHV.
/// Vectors in the frame of the rig: the left camera's own axes unless a file says otherwise.
struct CahvorModel {
  int width = 0;
  int height = 0;
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
  Eigen::Vector3d A = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d H = Eigen::Vector3d::UnitX();
  Eigen::Vector3d V = Eigen::Vector3d::UnitY();
  Eigen::Vector3d O = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d R = Eigen::Vector3d::Zero();
};

/// Pinhole intrinsics with OpenCV's plumb-bob distortion (k1 k2 p1 p2 k3), as RIG.toml gives them.
struct RigCamera {
  PinholeCamera pinhole;
  std::array<double, 5> distortion{};
  std::optional<CahvorModel> cahvor;  ///< set when RIG.toml names a model_file; then it decides
};

/// A stereo pair on a vehicle.
struct StereoRig {
  RigCamera left;
  RigCamera right;
  double baseline_m = 1.0;
  bool rectified = true;             ///< rows of the pictures are already epipolar lines
  int min_disparity_px = 0;          ///< fixed start of the disparity window; 0: follow the pose
  int num_disparities = 0;           ///< 0: follow the pose
  double tilt_rad = -0.78539816339;  ///< camera about body +y, negative down (E6)
  Eigen::Vector3d position_body_m = Eigen::Vector3d::Zero();  ///< left focal point in B
  double rate_hz = 10;

  /// X_BC of the left camera.
  RigidTransform X_BC() const { return {CameraRotationFromTilt(tilt_rad), position_body_m}; }
};

}  // namespace palace
