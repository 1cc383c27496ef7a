#include "engine/navigation/inertial_kalman.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/units.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kCoastingNoise = 1.0;      // m/s^2/sqrt(Hz)
constexpr double kGate3 = 13.93;            // 0.997 quantile of chi-square, 3 dof
constexpr double kGate6 = 19.80;            // 6 dof
constexpr double kFloorPosition_m = 0.001;  // P never claims more than this
constexpr double kFloorVelocity_mps = 0.005;
constexpr double kFloorBias_mps2 = 0.002;

void FloorCovariance(Matrix9d& P) {
  const double floor[3] = {kFloorPosition_m, kFloorVelocity_mps, kFloorBias_mps2};
  for (int i = 0; i < 9; ++i) {
    P(i, i) = std::max(P(i, i), floor[i / 3] * floor[i / 3]);
  }
  P = 0.5 * (P + P.transpose()).eval();
}

/// Joseph form: stays positive definite whatever the rounding.
template <int N>
Innovation Apply(InertialState& state, const Eigen::Matrix<double, N, 1>& difference,
                 const Eigen::Matrix<double, N, N>& R, double gate) {
  Eigen::Matrix<double, N, 9> H = Eigen::Matrix<double, N, 9>::Zero();
  H.template leftCols<N>().setIdentity();
  const Eigen::Matrix<double, N, N> S = H * state.P * H.transpose() + R;
  const Eigen::LDLT<Eigen::Matrix<double, N, N>> solver(S);
  Innovation innovation;
  innovation.dof = N;
  innovation.squared = difference.dot(solver.solve(difference));
  innovation.gate = gate;
  innovation.within_gate = innovation.squared <= gate;
  if (innovation.within_gate) {
    const Eigen::Matrix<double, 9, N> K = solver.solve(H * state.P).transpose();
    const Matrix9d keep = Matrix9d::Identity() - K * H;
    state.x += K * difference;
    state.P = keep * state.P * keep.transpose() + K * R * K.transpose();
    FloorCovariance(state.P);
  }
  return innovation;
}

}  // namespace

void PredictState(InertialState& state, Timestamp time, const InertialInput& input,
                  const ProcessNoise& noise) {
  const double dt = SecondsBetween(state.time, time);
  if (!(dt > 0)) {
    return;
  }
  const Vector3d gravity_W(0, 0, kStandardGravity_mps2);
  Vector3d accel_W = Vector3d::Zero();
  Matrix9d F = Matrix9d::Identity();
  F.block<3, 3>(0, 3) = dt * Matrix3d::Identity();
  if (!input.coasting) {
    accel_W = input.R_WB * (input.specific_force_B - state.x.tail<3>()) + gravity_W;
    F.block<3, 3>(0, 6) = -0.5 * dt * dt * input.R_WB;
    F.block<3, 3>(3, 6) = -dt * input.R_WB;
  }
  state.x.head<3>() += dt * state.x.segment<3>(3) + 0.5 * dt * dt * accel_W;
  state.x.segment<3>(3) += dt * accel_W;
  state.P = F * state.P * F.transpose();
  for (int i = 0; i < 3; ++i) {
    const double density = input.coasting ? kCoastingNoise : noise.accel_mps2_rthz[i];
    const double q = density * density;
    state.P(i, i) += q * dt * dt * dt / 3;
    state.P(i, i + 3) += q * dt * dt / 2;
    state.P(i + 3, i) += q * dt * dt / 2;
    state.P(i + 3, i + 3) += q * dt;
    state.P(i + 6, i + 6) += noise.bias_walk_mps3_rthz * noise.bias_walk_mps3_rthz * dt;
  }
  state.time = time;
}

Innovation UpdateState(InertialState& state, const PositionMeasurement& fix) {
  PALACE_CHECK(state.time == fix.time, state.time.us, fix.time.us);
  if (!fix.v_WB) {
    const Vector3d difference = fix.p_WB - state.x.head<3>();
    return Apply<3>(state, difference, fix.p_covariance_m2, kGate3);
  }
  Eigen::Matrix<double, 6, 1> difference;
  difference << fix.p_WB - state.x.head<3>(), *fix.v_WB - state.x.segment<3>(3);
  Eigen::Matrix<double, 6, 6> R = Eigen::Matrix<double, 6, 6>::Zero();
  R.topLeftCorner<3, 3>() = fix.p_covariance_m2;
  R.bottomRightCorner<3, 3>() = fix.sigma_v_mps * fix.sigma_v_mps * Matrix3d::Identity();
  return Apply<6>(state, difference, R, kGate6);
}

}  // namespace palace
