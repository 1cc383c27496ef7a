// Rigid frames and the transforms between them, in monogram notation.
//
//   W  world, local level: north, east, down; origin fixed at session start
//   B  body: forward, right, down; origin at the autopilot's reference point
//   C  camera (C0 left, C1 right): right, down, forward; origin at the projection centre
//   M  map grid: parallel to W, moves by whole cells only
//   S  landing site: plane of the site, z up out of the ground; origin at the site's centre
//   T  calibration target: x along its columns, y along its rows, z into the board; first point
//
// X_AB maps coordinates in B to coordinates in A: p_AQ = R_AB * p_BQ + p_AB. Adjacent letters
// cancel.
#pragma once

#include <Eigen/Dense>

namespace palace {

/// Rigid transform X_AB. Positions in metres.
struct RigidTransform {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p_BQ) const { return R * p_BQ + p; }
  RigidTransform operator*(const RigidTransform& X_BC) const {
    return {R * X_BC.R, R * X_BC.p + p};
  }
  RigidTransform Inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Attitude as aerospace Euler angles, ZYX order: yaw about down, then pitch, then roll. Radians.
struct EulerAngles {
  double roll_rad = 0;
  double pitch_rad = 0;
  double yaw_rad = 0;
};

/// R_WB of a body with the given attitude.
Eigen::Matrix3d RotationFromEuler(const EulerAngles& attitude);
/// Inverse of RotationFromEuler; pitch in [-pi/2, pi/2].
EulerAngles EulerFromRotation(const Eigen::Matrix3d& R_WB);
/// R_BC of a camera tilted about body +y. tilt_rad is negative downwards: 0 horizon, -pi/2 nadir
/// (thesis 3.3-3.5, erratum E6).
Eigen::Matrix3d CameraRotationFromTilt(double tilt_rad);
/// Angle wrapped into (-pi, pi].
double WrapAngle(double angle_rad);
/// Height above the origin of W, up-positive. The one place where the sign of z flips.
inline double HeightFromDown(double down_m) { return -down_m; }

}  // namespace palace
