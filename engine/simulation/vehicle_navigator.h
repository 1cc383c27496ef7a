// The vehicle's own navigation: inertial propagation corrected by measurements that arrive late.
//
//   InertialTrack    v' = R_WB f_B + g - b, p' = v at 100 Hz, with one second of history, so that
//                    a correction made for a past moment is carried to the present.
//   GpsNavigator     InertialTrack and a Kalman filter (p, v, b per axis), of fixes at their stamps
//   VisionNavigator  InertialTrack and fixed gains, of POSITION_ESTIMATE at its stamps
//
// Both run side by side; the GPS solution never sees vision, so the way back is always open.
#pragma once

#include <deque>

#include "engine/core/frames.h"
#include "engine/model/vehicle_message.h"
#include "engine/model/vehicle_state.h"

namespace palace {

class InertialTrack {
 public:
  struct Point {
    Timestamp time;
    Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
    Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();
  };

  explicit InertialTrack(const Point& start) : points_{start} {}
  /// Acceleration of B in W, without bias.
  void Propagate(Timestamp now, const Eigen::Vector3d& a_W);
  /// The track at that time, or null when it is older than the history or in the future.
  const Point* At(Timestamp time) const;
  /// Adds a correction made at `time`, carried forward with constant velocity error.
  void Correct(Timestamp time, const Eigen::Vector3d& dp, const Eigen::Vector3d& dv);
  const Point& now() const { return points_.back(); }

 private:
  std::deque<Point> points_;
};

/// Acceleration of B in W from what the inertial unit and the attitude reference say.
Eigen::Vector3d AccelerationInWorld(const ImuSample& imu, const Eigen::Matrix3d& R_WB);

class GpsNavigator {
 public:
  /// `velocity_sigma_mps`: of the GPS's velocities, which no fix tells.
  GpsNavigator(const InertialTrack::Point& start, double velocity_sigma_mps);
  void Propagate(Timestamp now, const Eigen::Vector3d& a_W);
  void Update(const GpsFix& fix);
  const InertialTrack::Point& now() const { return track_.now(); }
  /// Estimated bias of a_W, m/s^2.
  const Eigen::Vector3d& bias_W() const { return bias_W_; }

 private:
  void Fuse(Timestamp time, int row, const Eigen::Vector3d& residual, double sigma);

  InertialTrack track_;
  double velocity_sigma_mps_;
  Eigen::Vector3d bias_W_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d P_;  ///< of (p, v, b); the three axes share it
};

class VisionNavigator {
 public:
  /// Position from the first estimate, velocity from the filter flown until now (no jump).
  VisionNavigator(Timestamp now, const PositionEstimate& first, const InertialTrack::Point& gps);
  /// a_W with the bias removed.
  void Propagate(Timestamp now, const Eigen::Vector3d& a_W);
  /// False when the estimate is too old, from the future, or implausibly far off; then unused.
  bool Update(const PositionEstimate& estimate);
  const InertialTrack::Point& now() const { return track_.now(); }

 private:
  InertialTrack track_;
};

}  // namespace palace
