#include "engine/simulation/rotorcraft.h"

#include "engine/core/check.h"
#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Vector3d;
using State = RotorcraftState;

/// Forces per angle or stick are per foot in the source, moments per velocity are per (ft/s).
RotorcraftParameters ToMetres(RotorcraftParameters p) {
  for (double* force : {&p.Xa, &p.Yb, &p.Za, &p.Zb, &p.Zr, &p.Zcol}) {
    *force *= kMetresPerFoot;
  }
  for (double* moment : {&p.Lu, &p.Lv, &p.Mu, &p.Mv, &p.Nv, &p.Nw}) {
    *moment /= kMetresPerFoot;
  }
  return p;
}

}  // namespace

Rotorcraft::Rotorcraft(const RotorcraftParameters& parameters, const Vector3d& p_WB, double yaw_rad)
    : si_(ToMetres(parameters)) {
  PALACE_CHECK(parameters.tau_p < kLongestPedalDelay_s, parameters.tau_p);
  x_.head<RigidBody::kSize>() = RestingBody(p_WB, yaw_rad);
}

Vector3d Rotorcraft::AeroForce(const State::Vector& x, double col, const Vector3d& v,
                               double thrust_ratio) const {
  const double a = x[State::kA], b = x[State::kB], r = x[RigidBody::kRate + 2];
  const double lift = (thrust_ratio - 1) * (si_.Zcol * col - kStandardGravity_mps2);
  return {si_.Xu * v.x() + si_.Xa * a, si_.Yv * v.y() + si_.Yb * b,
          si_.Za * a + si_.Zb * b + si_.Zw * v.z() + si_.Zr * r + si_.Zcol * col -
              kStandardGravity_mps2 + lift};
}

State::Vector Rotorcraft::Derivative(const State::Vector& x, const StickCommand& stick,
                                     const Surroundings& around) const {
  const RigidBody::Vector body = x.head<RigidBody::kSize>();
  const Vector3d v = AirVelocity(body, around.wind_W);
  const Vector3d rate = body.segment<3>(RigidBody::kRate);
  const double a = x[State::kA], b = x[State::kB], c = x[State::kC], d = x[State::kD];
  const RotorcraftParameters& s = si_;
  const Vector3d spin_up(s.Lu * v.x() + s.Lv * v.y() + s.Lb * b,
                         s.Mu * v.x() + s.Mv * v.y() + s.Ma * a,
                         s.Nv * v.y() + s.Np * rate.x() + s.Nw * v.z() + s.Nr * rate.z() +
                             s.Nrfb * x[State::kRfb] + s.Nped * stick.ped + s.Ncol * stick.col);
  State::Vector dx;
  dx.head<RigidBody::kSize>() =
      RigidBodyDerivative(body, AeroForce(x, stick.col, v, around.thrust_ratio), spin_up);
  dx[State::kA] =
      (-a + s.Ab * b + s.Ac * c + s.Alat * stick.lat + s.Alon * stick.lon) / s.tau_f - rate.y();
  dx[State::kB] =
      (-b + s.Ba * a + s.Bd * d + s.Blat * stick.lat + s.Blon * stick.lon) / s.tau_f - rate.x();
  dx[State::kC] = (-c + s.Clon * stick.lon) / s.tau_s - rate.y();
  dx[State::kD] = (-d + s.Dlat * stick.lat) / s.tau_s - rate.x();
  dx[State::kRfb] = s.Kr * rate.z() + s.Krfb * x[State::kRfb];
  return dx;
}

double Rotorcraft::DelayedPedal(double pedal) {
  pedal_head_ = (pedal_head_ + 1) % kPedalHistory;
  pedal_[static_cast<std::size_t>(pedal_head_)] = pedal;
  const double steps = si_.tau_p / kStep_s;
  const int whole = static_cast<int>(steps);
  const auto at = [&](int age) {
    return pedal_[static_cast<std::size_t>((pedal_head_ - age + kPedalHistory) % kPedalHistory)];
  };
  return at(whole) + (steps - whole) * (at(whole + 1) - at(whole));
}

void Rotorcraft::Step(const StickCommand& stick, const Surroundings& around) {
  if (frozen_) {
    return;
  }
  StickCommand delayed = stick;
  delayed.ped = DelayedPedal(stick.ped);
  x_ = RungeKutta4(x_, kStep_s,
                   [&](const State::Vector& x) { return Derivative(x, delayed, around); });
  x_.segment<4>(RigidBody::kQuaternion).normalize();
  last_stick_ = stick;
  last_around_ = around;
}

void Rotorcraft::Freeze() {
  frozen_ = true;
  x_.segment<3>(RigidBody::kVelocity).setZero();
  x_.tail<State::kSize - RigidBody::kRate>().setZero();
}

Vector3d Rotorcraft::SpecificForce() const {
  const BodyState now = body();
  const Eigen::Matrix3d R_BW = now.R_WB.transpose();
  if (frozen_) {
    return R_BW * Vector3d(0, 0, -kStandardGravity_mps2);
  }
  return AeroForce(x_, last_stick_.col, now.v_B - R_BW * last_around_.wind_W,
                   last_around_.thrust_ratio);
}

}  // namespace palace
