#include "engine/capture/euroc/euroc_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palace {
namespace {

constexpr double kSameAxes = 1e-9;  // of the elements of two rotations

}  // namespace

EurocMount MountOf(const RigidTransform& X_IC, const std::optional<RigidTransform>& X_RI_first) {
  EurocMount mount;
  const Eigen::Vector3d axis_I = X_IC.R.col(2);
  mount.tilt_rad = std::clamp(std::atan2(-axis_I.z(), axis_I.x()), -std::numbers::pi / 2, 0.0);
  mount.position_body_m = X_IC.p;
  const Eigen::Matrix3d turned = CameraRotationFromTilt(mount.tilt_rad) - X_IC.R;
  if (turned.cwiseAbs().maxCoeff() < kSameAxes) {
    return mount;
  }
  mount.tilt_rad = 0;
  if (X_RI_first) {
    const double down = (WorldFromEuroc() * X_RI_first->R * axis_I).z();
    mount.tilt_rad = -std::asin(std::clamp(down, 0.0, 1.0));
  }
  mount.R_IB = X_IC.R * CameraRotationFromTilt(mount.tilt_rad).transpose();
  mount.position_body_m = mount.R_IB.transpose() * X_IC.p;
  return mount;
}

RigidTransform PoseBetween(const RigidTransform& a, const RigidTransform& b, double share) {
  if (share <= 0 || share >= 1) {
    return share <= 0 ? a : b;
  }
  const Eigen::Quaterniond q_a(a.R), q_b(b.R);
  return {q_a.slerp(share, q_b).toRotationMatrix(), (1 - share) * a.p + share * b.p};
}

}  // namespace palace
