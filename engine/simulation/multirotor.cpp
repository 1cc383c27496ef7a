#include "engine/simulation/multirotor.h"

#include <cmath>

#include "engine/core/check.h"
#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using State = MultirotorState;

/// Rows: sum of thrust, roll, pitch, yaw moment; a thrust -f z at (x, y) has the moment (-y, x) f.
Eigen::Matrix4d EffectOf(const MultirotorParameters& p) {
  const double side_m = p.arm_m / std::sqrt(2.0), c = p.torque_per_thrust_m;
  const Vector4d ahead(side_m, side_m, -side_m, -side_m);
  const Vector4d right(side_m, -side_m, -side_m, side_m);
  Eigen::Matrix4d effect;
  effect.row(0).setOnes();
  effect.row(1) = -right.transpose();
  effect.row(2) = ahead.transpose();
  effect.row(3) << c, -c, c, -c;
  return effect;
}

}  // namespace

Multirotor::Multirotor(const MultirotorParameters& parameters, const Vector3d& p_WB, double yaw_rad)
    : p_(parameters), effect_(EffectOf(parameters)), mixing_(effect_.inverse()) {
  PALACE_CHECK(p_.mass_kg > 0 && p_.motor_lag_s > 0 && p_.inertia_kgm2.minCoeff() > 0, p_.mass_kg);
  x_.head<RigidBody::kSize>() = RestingBody(p_WB, yaw_rad);
  x_.tail<4>().setConstant(p_.mass_kg * kStandardGravity_mps2 / 4);
}

Vector3d Multirotor::Force(const State::Vector& x, const Vector3d& v_air_B,
                           double thrust_ratio) const {
  const double thrust_n = thrust_ratio * x.tail<4>().sum();
  return (Vector3d(0, 0, -thrust_n) - p_.drag_ns_per_m.cwiseProduct(v_air_B)) / p_.mass_kg;
}

Vector4d Multirotor::Mix(const StickCommand& stick, const Vector3d& rate_B) const {
  const Vector3d& J = p_.inertia_kgm2;
  const Vector3d wanted_rate =
      p_.max_rate_rad_s.cwiseProduct(Vector3d(stick.lat, -stick.lon, stick.ped));
  const Vector3d turn_up = p_.rate_gain_per_s.cwiseProduct(wanted_rate - rate_B);
  const Vector3d moment = J.cwiseProduct(turn_up) + rate_B.cross(J.cwiseProduct(rate_B));
  const double thrust_n = p_.mass_kg * kStandardGravity_mps2 * (1 + stick.col);
  const Vector4d wanted(thrust_n, moment.x(), moment.y(), moment.z());
  return (mixing_ * wanted).cwiseMax(p_.min_thrust_n).cwiseMin(p_.max_thrust_n);
}

State::Vector Multirotor::Derivative(const State::Vector& x, const Vector4d& asked_n,
                                     const Surroundings& around) const {
  const RigidBody::Vector body = x.head<RigidBody::kSize>();
  const Vector3d rate = body.segment<3>(RigidBody::kRate);
  const Vector3d& J = p_.inertia_kgm2;
  const Vector3d moment = (effect_ * x.tail<4>()).tail<3>();
  const Vector3d spin_up = (moment - rate.cross(J.cwiseProduct(rate))).cwiseQuotient(J);
  State::Vector dx;
  dx.head<RigidBody::kSize>() = RigidBodyDerivative(
      body, Force(x, AirVelocity(body, around.wind_W), around.thrust_ratio), spin_up);
  dx.tail<4>() = (asked_n - x.tail<4>()) / p_.motor_lag_s;
  return dx;
}

void Multirotor::Step(const StickCommand& stick, const Surroundings& around) {
  if (frozen_) {
    return;
  }
  const Vector4d asked_n = Mix(stick, x_.segment<3>(RigidBody::kRate));
  x_ = RungeKutta4(x_, kStep_s,
                   [&](const State::Vector& x) { return Derivative(x, asked_n, around); });
  x_.segment<4>(RigidBody::kQuaternion).normalize();
  last_around_ = around;
}

void Multirotor::Freeze() {
  frozen_ = true;
  x_.segment<3>(RigidBody::kVelocity).setZero();
  x_.tail<State::kSize - RigidBody::kRate>().setZero();
}

Vector3d Multirotor::SpecificForce() const {
  const BodyState now = body();
  if (frozen_) {
    return now.R_WB.transpose() * Vector3d(0, 0, -kStandardGravity_mps2);
  }
  return Force(x_, now.v_B - now.R_WB.transpose() * last_around_.wind_W, last_around_.thrust_ratio);
}

}  // namespace palace
