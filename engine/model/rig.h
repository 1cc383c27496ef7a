// The stereo rig: two cameras, their mount on the airframe, and the disparity window.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/model/camera_models.h"

namespace palace {

/// One camera of a rig: a model of any family where RIG.toml names a model_file, else the pinhole
/// with OpenCV's plumb-bob distortion (k1 k2 p1 p2 k3) that it writes out. Those two are rectified
/// differently: models tell how the cameras are turned, written-out pinholes are taken as parallel.
struct RigCamera {
  PinholeCamera pinhole;  ///< with a model: of its linear part
  std::array<double, 5> distortion{};
  std::optional<CameraModel> model{};  ///< lengths in metres, the pose known; then it decides
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
