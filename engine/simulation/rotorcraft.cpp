#include "engine/simulation/rotorcraft.h"

#include <cmath>

#include "engine/core/check.h"
#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Vector3d;
using Index = RotorcraftState::Index;

Eigen::Quaterniond Attitude(const RotorcraftState::Vector& x) {
  return {x[Index::kQuaternion], x[Index::kQuaternion + 1], x[Index::kQuaternion + 2],
          x[Index::kQuaternion + 3]};
}

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

RotorcraftParameters R50Hover() {
  RotorcraftParameters p{};
  p.tau_f = 0.046, p.tau_s = 0.342, p.tau_p = 0.0991;
  p.Xu = -0.0505, p.Xa = -32.2, p.Yv = -0.154, p.Yb = 32.2;
  p.Lu = -0.144, p.Lv = 0.143, p.Lb = 166;
  p.Mu = -0.0561, p.Mv = -0.0585, p.Ma = 82.6;
  p.Ab = -0.189, p.Ac = 0.644, p.Alat = 0.0313, p.Alon = -0.100;
  p.Ba = 0.368, p.Bd = 0.710, p.Blat = 0.140, p.Blon = 0.0138;
  p.Za = -9.75, p.Zb = -131, p.Zw = -0.614, p.Zr = 0.93, p.Zcol = -45.8;
  p.Np = -3.53, p.Nv = 0.0301, p.Nw = 0.0857, p.Nr = -4.13, p.Nrfb = -33.1;
  p.Nped = 33.1, p.Ncol = -3.33, p.Kr = 2.16, p.Krfb = -8.26;
  p.Clon = -0.259, p.Dlat = 0.273;
  return p;
}

Eigen::Matrix3d RotorcraftState::R_WB() const { return Attitude(x).toRotationMatrix(); }

Rotorcraft::Rotorcraft(const RotorcraftParameters& parameters, const Vector3d& p_WB, double yaw_rad)
    : si_(ToMetres(parameters)) {
  PALACE_CHECK(parameters.tau_p < kStep_s * (kPedalHistory - 2), parameters.tau_p);
  state_.x.segment<3>(Index::kPosition) = p_WB;
  state_.x[Index::kQuaternion] = std::cos(yaw_rad / 2);
  state_.x[Index::kQuaternion + 3] = std::sin(yaw_rad / 2);
}

Vector3d Rotorcraft::AeroForce(const RotorcraftState::Vector& x, double col,
                               const Vector3d& v) const {
  const double a = x[Index::kA], b = x[Index::kB], r = x[Index::kRate + 2];
  return {si_.Xu * v.x() + si_.Xa * a, si_.Yv * v.y() + si_.Yb * b,
          si_.Za * a + si_.Zb * b + si_.Zw * v.z() + si_.Zr * r + si_.Zcol * col -
              kStandardGravity_mps2};
}

RotorcraftState::Vector Rotorcraft::Derivative(const RotorcraftState::Vector& x,
                                               const StickCommand& stick,
                                               const Vector3d& wind_W) const {
  const Eigen::Quaterniond q_WB = Attitude(x).normalized();
  const Eigen::Matrix3d R_WB = q_WB.toRotationMatrix();
  const Vector3d v_B = x.segment<3>(Index::kVelocity);
  const Vector3d rate = x.segment<3>(Index::kRate);
  const Vector3d v = v_B - R_WB.transpose() * wind_W;
  const double a = x[Index::kA], b = x[Index::kB], c = x[Index::kC], d = x[Index::kD];
  const RotorcraftParameters& s = si_;

  RotorcraftState::Vector dx;
  dx.segment<3>(Index::kPosition) = R_WB * v_B;
  dx.segment<3>(Index::kVelocity) = AeroForce(x, stick.col, v) +
                                    R_WB.transpose() * Vector3d(0, 0, kStandardGravity_mps2) -
                                    rate.cross(v_B);
  const Eigen::Quaterniond spin = q_WB * Eigen::Quaterniond(0, rate.x(), rate.y(), rate.z());
  dx.segment<4>(Index::kQuaternion) << 0.5 * spin.w(), 0.5 * spin.x(), 0.5 * spin.y(),
      0.5 * spin.z();
  dx.segment<3>(Index::kRate) << s.Lu * v.x() + s.Lv * v.y() + s.Lb * b,
      s.Mu * v.x() + s.Mv * v.y() + s.Ma * a,
      s.Nv * v.y() + s.Np * rate.x() + s.Nw * v.z() + s.Nr * rate.z() + s.Nrfb * x[Index::kRfb] +
          s.Nped * stick.ped + s.Ncol * stick.col;
  dx[Index::kA] =
      (-a + s.Ab * b + s.Ac * c + s.Alat * stick.lat + s.Alon * stick.lon) / s.tau_f - rate.y();
  dx[Index::kB] =
      (-b + s.Ba * a + s.Bd * d + s.Blat * stick.lat + s.Blon * stick.lon) / s.tau_f - rate.x();
  dx[Index::kC] = (-c + s.Clon * stick.lon) / s.tau_s - rate.y();
  dx[Index::kD] = (-d + s.Dlat * stick.lat) / s.tau_s - rate.x();
  dx[Index::kRfb] = s.Kr * rate.z() + s.Krfb * x[Index::kRfb];
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

void Rotorcraft::Step(const StickCommand& stick, const Vector3d& wind_W) {
  if (frozen_) {
    return;
  }
  StickCommand delayed = stick;
  delayed.ped = DelayedPedal(stick.ped);
  const double h = kStep_s;
  const RotorcraftState::Vector& x = state_.x;
  const RotorcraftState::Vector k1 = Derivative(x, delayed, wind_W);
  const RotorcraftState::Vector k2 = Derivative(x + h / 2 * k1, delayed, wind_W);
  const RotorcraftState::Vector k3 = Derivative(x + h / 2 * k2, delayed, wind_W);
  const RotorcraftState::Vector k4 = Derivative(x + h * k3, delayed, wind_W);
  state_.x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  state_.x.segment<4>(Index::kQuaternion).normalize();
  last_stick_ = stick;
  last_wind_W_ = wind_W;
}

void Rotorcraft::Freeze() {
  frozen_ = true;
  state_.x.segment<3>(Index::kVelocity).setZero();
  state_.x.tail<RotorcraftState::kSize - Index::kRate>().setZero();
}

Vector3d Rotorcraft::SpecificForce() const {
  const Eigen::Matrix3d R_BW = state_.R_WB().transpose();
  if (frozen_) {
    return R_BW * Vector3d(0, 0, -kStandardGravity_mps2);
  }
  return AeroForce(state_.x, last_stick_.col, state_.v_B() - R_BW * last_wind_W_);
}

}  // namespace palace
