// FixedGainFilter: position and velocity from inertial data and position fixes with constant gains,
// as the vehicle of the thesis had for its GPS and, beside it, for vision (5.1.1).
//
// State per axis of W: p, v, b (bias of the acceleration). Between fixes
//   v += (a_W - b) dt,   p += v dt + (a_W - b) dt^2 / 2,
// and at each fix z, whenever it comes,
//   (p, v, b) += (k_p, k_v, k_b) (z - p).
// The gains are those at which a Kalman filter settles whose fixes come every `period_s`, on time:
// a filter that is fed otherwise neither knows nor asks. Source: Bar-Shalom, Li and Kirubarajan
// 2001, 5.2.5 (steady state).
#pragma once

#include <Eigen/Dense>

namespace palace {

struct FixedGainDesign {
  double accel_noise_mps2_rthz = 0;
  double bias_walk_mps3_rthz = 0.005;
  double fix_sigma_m = 0;
  double period_s = 0.1;
};

/// (k_p, k_v in 1/s, k_b in 1/s^2).
Eigen::Vector3d SteadyGains(const FixedGainDesign& design);

class FixedGainFilter {
 public:
  FixedGainFilter(const FixedGainDesign& design, const Eigen::Vector3d& p_WB,
                  const Eigen::Vector3d& v_WB)
      : gains_(SteadyGains(design)), p_WB_(p_WB), v_WB_(v_WB) {}

  void Propagate(const Eigen::Vector3d& a_W, double dt_s);
  void AddFix(const Eigen::Vector3d& p_WB);
  const Eigen::Vector3d& p_WB() const { return p_WB_; }
  const Eigen::Vector3d& v_WB() const { return v_WB_; }

 private:
  Eigen::Vector3d gains_;
  Eigen::Vector3d p_WB_;
  Eigen::Vector3d v_WB_;
  Eigen::Vector3d bias_W_ = Eigen::Vector3d::Zero();
};

}  // namespace palace
