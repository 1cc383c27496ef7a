// The linear Kalman filter behind PositionFilter: one state, one step, one update.
// Equations in position_filter.h.
#pragma once

#include <limits>
#include <optional>

#include <Eigen/Dense>

#include "engine/core/time.h"

namespace palace {

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

struct InertialState {
  Timestamp time;
  Vector9d x = Vector9d::Zero();  ///< p_WB, v_WB, b_B
  Matrix9d P = Matrix9d::Identity();
};

/// Spectral densities, per axis of W.
struct ProcessNoise {
  Eigen::Vector3d accel_mps2_rthz = Eigen::Vector3d::Constant(0.03);
  double bias_walk_mps3_rthz = 0.002;
};

/// Position in W with covariance, and velocity where the sensor gives one.
struct PositionMeasurement {
  Timestamp time;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  Eigen::Matrix3d p_covariance_m2 = Eigen::Matrix3d::Identity();
  std::optional<Eigen::Vector3d> v_WB;
  double sigma_v_mps = 0.1;
};

/// What drives one step: specific force and attitude, or nothing known (coasting).
struct InertialInput {
  Eigen::Vector3d specific_force_B = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
  bool coasting = false;  ///< no IMU: zero acceleration, 1 m/s^2/sqrt(Hz) of noise
};

/// Steps the state to `time`; nothing happens when it is not later.
void PredictState(InertialState& state, Timestamp time, const InertialInput& input,
                  const ProcessNoise& noise);

/// Normalised innovation squared and its degrees of freedom.
struct Innovation {
  double squared = 0;
  int dof = 3;
  double gate = std::numeric_limits<double>::quiet_NaN();  ///< the largest square that is used
  bool within_gate = false;
};
/// Gates, and, when inside, updates. The times must agree.
Innovation UpdateState(InertialState& state, const PositionMeasurement& fix);

}  // namespace palace
