// What every flight model of the simulator shares: a rigid body near the ground of a flat earth.
//
//   p_W' = R_WB v_B,   v_B' = f_B + R_BW g_W - omega x v_B,   q_WB' = q_WB omega / 2
//   omega' is the model's own
//
// f_B is the specific force (all forces but gravity over the mass), so what an accelerometer reads.
// The first kSize numbers of a model's state are these; its own follow.
#pragma once

#include <Eigen/Dense>

namespace palace {

struct RigidBody {
  static constexpr int kPosition = 0, kVelocity = 3, kQuaternion = 6, kRate = 10, kSize = 13;
  using Vector = Eigen::Matrix<double, kSize, 1>;
};

/// p_WB, v_B, attitude (w x y z) and body rates as the world asks for them. SI.
struct BodyState {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_B = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
  Eigen::Vector3d angular_rate_B = Eigen::Vector3d::Zero();

  Eigen::Vector3d v_WB() const { return R_WB * v_B; }
};
BodyState BodyStateOf(const RigidBody::Vector& x);
/// Velocity against the air, in B. Brings the quaternion to unit length, which it loses in a step.
Eigen::Vector3d AirVelocity(const RigidBody::Vector& x, const Eigen::Vector3d& wind_W);

/// At rest, level.
RigidBody::Vector RestingBody(const Eigen::Vector3d& p_WB, double yaw_rad);

/// What acts on the body besides its own rotors' doing.
struct Surroundings {
  Eigen::Vector3d wind_W = Eigen::Vector3d::Zero();  ///< velocity of the air
  double thrust_ratio = 1;                           ///< in ground effect over free of it
};

/// `angular_acceleration_B` in rad/s^2.
RigidBody::Vector RigidBodyDerivative(const RigidBody::Vector& x,
                                      const Eigen::Vector3d& specific_force_B,
                                      const Eigen::Vector3d& angular_acceleration_B);

/// x after a step of h by the classic Runge-Kutta formula of fourth order.
template <typename Vector, typename Derivative>
Vector RungeKutta4(const Vector& x, double h, const Derivative& derivative) {
  const Vector k1 = derivative(x);
  const Vector k2 = derivative(Vector(x + h / 2 * k1));
  const Vector k3 = derivative(Vector(x + h / 2 * k2));
  const Vector k4 = derivative(Vector(x + h * k3));
  return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

}  // namespace palace
