#include "engine/simulation/rigid_body.h"

#include <cmath>

#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Vector3d;
using Index = RigidBody;

Eigen::Quaterniond Attitude(const RigidBody::Vector& x) {
  return {x[Index::kQuaternion], x[Index::kQuaternion + 1], x[Index::kQuaternion + 2],
          x[Index::kQuaternion + 3]};
}

}  // namespace

BodyState BodyStateOf(const RigidBody::Vector& x) {
  return {x.segment<3>(Index::kPosition), x.segment<3>(Index::kVelocity),
          Attitude(x).toRotationMatrix(), x.segment<3>(Index::kRate)};
}

Vector3d AirVelocity(const RigidBody::Vector& x, const Vector3d& wind_W) {
  const Eigen::Matrix3d R_WB = Attitude(x).normalized().toRotationMatrix();
  return x.segment<3>(Index::kVelocity) - R_WB.transpose() * wind_W;
}

RigidBody::Vector RestingBody(const Vector3d& p_WB, double yaw_rad) {
  RigidBody::Vector x = RigidBody::Vector::Zero();
  x.segment<3>(Index::kPosition) = p_WB;
  x[Index::kQuaternion] = std::cos(yaw_rad / 2);
  x[Index::kQuaternion + 3] = std::sin(yaw_rad / 2);
  return x;
}

RigidBody::Vector RigidBodyDerivative(const RigidBody::Vector& x, const Vector3d& specific_force_B,
                                      const Vector3d& angular_acceleration_B) {
  const Eigen::Quaterniond q_WB = Attitude(x).normalized();
  const Eigen::Matrix3d R_WB = q_WB.toRotationMatrix();
  const Vector3d v_B = x.segment<3>(Index::kVelocity);
  const Vector3d rate = x.segment<3>(Index::kRate);
  RigidBody::Vector dx;
  dx.segment<3>(Index::kPosition) = R_WB * v_B;
  dx.segment<3>(Index::kVelocity) =
      specific_force_B + R_WB.transpose() * Vector3d(0, 0, kStandardGravity_mps2) - rate.cross(v_B);
  const Eigen::Quaterniond spin = q_WB * Eigen::Quaterniond(0, rate.x(), rate.y(), rate.z());
  dx.segment<4>(Index::kQuaternion) << 0.5 * spin.w(), 0.5 * spin.x(), 0.5 * spin.y(),
      0.5 * spin.z();
  dx.segment<3>(Index::kRate) = angular_acceleration_B;
  return dx;
}

}  // namespace palace
