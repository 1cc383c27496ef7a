#include "engine/experiments/fixed_gain_filter.h"

namespace palace {

Eigen::Vector3d SteadyGains(const FixedGainDesign& design) {
  const double T = design.period_s;
  const double qa = design.accel_noise_mps2_rthz * design.accel_noise_mps2_rthz;
  const double qb = design.bias_walk_mps3_rthz * design.bias_walk_mps3_rthz;
  Eigen::Matrix3d F, Q;
  F << 1, T, -T * T / 2,  //
      0, 1, -T,           //
      0, 0, 1;
  Q << qa * T * T * T / 3, qa * T * T / 2, 0,  //
      qa * T * T / 2, qa * T, 0,               //
      0, 0, qb * T;
  Eigen::Matrix3d P = Eigen::Matrix3d::Identity();
  Eigen::Vector3d gain = Eigen::Vector3d::Zero();
  constexpr int kSettled = 20000;
  for (int i = 0; i < kSettled; ++i) {
    P = F * P * F.transpose() + Q;
    gain = P.col(0) / (P(0, 0) + design.fix_sigma_m * design.fix_sigma_m);
    P -= (gain * P.row(0)).eval();
  }
  return gain;
}

void FixedGainFilter::Propagate(const Eigen::Vector3d& a_W, double dt_s) {
  const Eigen::Vector3d a = a_W - bias_W_;
  p_WB_ += dt_s * v_WB_ + dt_s * dt_s / 2 * a;
  v_WB_ += dt_s * a;
}

void FixedGainFilter::AddFix(const Eigen::Vector3d& p_WB) {
  const Eigen::Vector3d residual = p_WB - p_WB_;
  p_WB_ += gains_[0] * residual;
  v_WB_ += gains_[1] * residual;
  bias_W_ += gains_[2] * residual;
}

}  // namespace palace
