#include "engine/core/frames.h"

#include <cmath>
#include <numbers>

namespace palace {

Eigen::Matrix3d RotationFromEuler(const EulerAngles& attitude) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(attitude.yaw_rad, Vector3d::UnitZ()) *
          AngleAxisd(attitude.pitch_rad, Vector3d::UnitY()) *
          AngleAxisd(attitude.roll_rad, Vector3d::UnitX()))
      .toRotationMatrix();
}

EulerAngles EulerFromRotation(const Eigen::Matrix3d& R_WB) {
  EulerAngles attitude;
  attitude.roll_rad = std::atan2(R_WB(2, 1), R_WB(2, 2));
  attitude.pitch_rad = std::atan2(-R_WB(2, 0), std::hypot(R_WB(2, 1), R_WB(2, 2)));
  attitude.yaw_rad = std::atan2(R_WB(1, 0), R_WB(0, 0));
  return attitude;
}

Eigen::Matrix3d CameraRotationFromTilt(double tilt_rad) {
  // Columns: camera right, down, forward, expressed in body forward-right-down for zero tilt.
  Eigen::Matrix3d R_level;
  R_level << 0, 0, 1,  //
      1, 0, 0,         //
      0, 1, 0;
  return Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() * R_level;
}

double WrapAngle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2 * std::numbers::pi : wrapped;
}

}  // namespace palace
