// The frames of EuRoC folders and ours.
//
//   R  their world: z up against gravity, x and y level; heading and origin are the ground truth's
//   I  their body: the IMU, its axes as it happens to be mounted; sensor.yaml tells X_IC as T_BS
//   W  north, east, down. The folder tells no north: x of R is taken as east, y as north, so that
//      R, W and a map agree:  p_W = (y_R, x_R, -z_R),  R_WR = [0 1 0; 1 0 0; 0 0 -1] = R_RW
//   B  forward, right, down, with the origin of I. A rig's camera is tilted about body y alone
//      (StereoRig::X_BC), so B is turned against I by what is left:  R_IB = R_IC R_BC(tilt)^T
//
// Where R_IC is such a tilt already, as in folders of our own, B is I. Elsewhere the tilt is that
// of the left camera below the horizon at the first picture with a pose (0 above it, or without a
// pose): the body of an upright camera is then level there. Every choice leaves X_WC = X_WR X_RI
// X_IC as it is. Source: Burri et al., The EuRoC micro aerial vehicle datasets, IJRR 2016, section
// 4; the letters R and I are ours for their R and B.
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"

namespace palace {

/// R_WR, which is R_RW too.
inline Eigen::Matrix3d WorldFromEuroc() {
  Eigen::Matrix3d R_WR;
  R_WR << 0, 1, 0,  //
      1, 0, 0,      //
      0, 0, -1;
  return R_WR;
}

/// How the left camera sits on the body that we make of theirs.
struct EurocMount {
  double tilt_rad = 0;  ///< -pi/2 .. 0
  Eigen::Matrix3d R_IB = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position_body_m = Eigen::Vector3d::Zero();

  /// X_WB of their X_RI.
  RigidTransform BodyPose(const RigidTransform& X_RI) const {
    return {WorldFromEuroc() * X_RI.R * R_IB, WorldFromEuroc() * X_RI.p};
  }
};

/// `X_RI_first`: of the first picture with a pose.
EurocMount MountOf(const RigidTransform& X_IC, const std::optional<RigidTransform>& X_RI_first);

/// Between two poses: straight, turning evenly (slerp). `share` 0 gives `a`, 1 gives `b`, exactly.
RigidTransform PoseBetween(const RigidTransform& a, const RigidTransform& b, double share);

}  // namespace palace
