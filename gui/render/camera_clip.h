// Projection of an ideal pinhole camera as OpenGL wants it.
#pragma once

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/rig.h"

namespace palace {

inline constexpr double kNear_m = 0.05;
inline constexpr double kFar_m = 600;

/// Clip space with y downwards: row 0 of GL's memory becomes the top row of the picture. Pixel
/// (x, y) is GL's window coordinate (x + 0.5, y + 0.5).
inline Eigen::Matrix4d ClipFromCamera(const PinholeCamera& camera) {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2 * camera.fx_px / camera.width;
  clip(0, 2) = (2 * camera.cx_px + 1) / camera.width - 1;
  clip(1, 1) = 2 * camera.fy_px / camera.height;
  clip(1, 2) = (2 * camera.cy_px + 1) / camera.height - 1;
  clip(2, 2) = (kFar_m + kNear_m) / (kFar_m - kNear_m);
  clip(2, 3) = -2 * kFar_m * kNear_m / (kFar_m - kNear_m);
  clip(3, 2) = 1;
  return clip;
}

/// Distance along the optical axis, metres, of a window depth 0 .. 1 of that projection.
inline double DepthOfWindow(double window) {
  return kFar_m * kNear_m / (kFar_m - window * (kFar_m - kNear_m));
}

/// Of positions relative to the camera, so that only small numbers go to single precision.
inline Eigen::Matrix4f ClipFromRelative(const PinholeCamera& camera, const RigidTransform& X_WC) {
  Eigen::Matrix4d camera_from_world = Eigen::Matrix4d::Identity();
  camera_from_world.topLeftCorner<3, 3>() = X_WC.R.transpose();
  return (ClipFromCamera(camera) * camera_from_world).cast<float>();
}

}  // namespace palace
