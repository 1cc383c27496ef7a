// LandmarkFrame: how the landmarks of one site lie turned in W, learned while they are tracked.
//
// One told attitude placed them, with the bias and the noise that it had at that moment: they lie
// turned by b + n. Small rotation vectors, b and n in axes of W; the bias is the body's and turns
// with it (R_k = R_WB of picture k, first-order Gauss-Markov with sigma_b and T):
//
//   b = R_0 beta_0
//   m_k = R_k beta_k - b - n + v_k   the attitude told against the one that the landmarks show
//   l_k = R_k beta_k + a / g         the tilt that the inertial filter sees as a bias of its
//                                    accelerometer, whose own bias is a; level axes only
//
// A Kalman filter of (n, b, beta_k) takes every m_k but the first, of the picture that placed them:
// n is told in the first seconds, before the bias has wandered as far as the noise, and the bias as
// far as the vehicle turns. Gravity says the rest but the heading. It is the inertial filter's word
// of many seconds, so it is not added up but weighed anew with each picture.
//
// Fixes are turned back by n about where the landmarks were placed from, and by b about the site,
// for the same bias laid the site there. The ground stays at the site's height, where the tracker
// laid it. What is left of both is told (shared_errors.h).
#pragma once

#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/time.h"
#include "engine/core/units.h"
#include "engine/model/view_pose.h"
#include "engine/navigation/inertial_kalman.h"
#include "engine/navigation/shared_errors.h"

namespace palace {

/// Of the attitude that the vehicle tells, one standard deviation of each axis, and of the
/// accelerometer that tells the vertical. Noise is what the pose tells of itself
/// (VehiclePose::sigmas); no message tells the rest: that of the R-50's file.
struct AttitudeErrors {
  double noise_rad = PoseSigmas{}.attitude_rad;  ///< from one pose to the next
  double bias_rad = Rad(0.15);                   ///< wanders with bias_time_s
  double bias_time_s = 300;
  double accel_bias_mps2 = 0.02;
};

/// The accelerometer's bias as an inertial filter has it, in axes of W.
struct FeltBias {
  Eigen::Vector3d accel_W_mps2 = Eigen::Vector3d::Zero();
  double sigma_mps2 = 0;  ///< of the filter alone, level axes
};

/// What was told of one picture, and what its landmarks show.
struct ToldAttitude {
  Timestamp time;
  RigidTransform X_WC_resected;
  Eigen::Matrix3d R_WC = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
  std::optional<FeltBias> felt{};
};

class LandmarkFrame {
 public:
  void Add(const ToldAttitude& told, const AttitudeErrors& errors);
  /// A pose by the landmarks, turned back. As given before the first Add.
  RigidTransform Levelled(const RigidTransform& X_W, const Eigen::Vector3d& p_WS) const;
  const Eigen::Vector3d& placed_from_W() const { return placed_from_W_; }
  /// Of what is left of n and b.
  TurnCovariance left_rad2() const { return told_.P.topLeftCorner<6, 6>(); }

 private:
  struct Turns {
    Vector9d x = Vector9d::Zero();  ///< n, b, beta
    Matrix9d P = Matrix9d::Zero();

    /// y = H x + noise; what is off by more than three sigma counts as three.
    void Take(const Eigen::MatrixXd& H, const Eigen::VectorXd& y, double variance);
  };
  void Place(const ToldAttitude& told, const AttitudeErrors& errors);
  void Wander(double seconds, const AttitudeErrors& errors);

  bool placed_ = false;
  Timestamp time_;
  Eigen::Vector3d placed_from_W_ = Eigen::Vector3d::Zero();
  Turns seen_;  ///< by landmarks alone
  Turns told_;  ///< with what gravity says now
};

}  // namespace palace
