// GravityWatch: does the attitude agree with gravity?
//
// What the inertial unit feels, turned by the attitude, less gravity is how fast the velocity
// changes; GPS measures that velocity by itself. Over the last 5 s
//
//   r_k = v_GPS(t_k) - integral up to t_k of (R_WB f_B + g_W) dt
//
// has the horizontal slope s, by least squares: with an attitude that is tilted by an angle a about
// a level axis, |s| = g tan(a). Off beyond 1.5 deg and six sigma of that fit twice in a row; five
// times in a row below both end it. A step of 3 deg shows after 2.5 s of fixes at 5 Hz.
//
// An accelerometer's bias of g tan(a) looks the same, and is told in the same words. A wrong
// heading shows in neither, as long as nothing accelerates. Without GPS velocities, while GPS is
// doubted, and for 3 s after a gap in attitude or inertial data the tilt is unknown (NaN); what was
// off stays off until the tilt is known again.
// Source: Titterton & Weston 2004, chapter 10 (alignment against an aiding velocity).
#pragma once

#include <deque>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/navigation_status.h"
#include "engine/model/vehicle_state.h"

namespace palace {

class GravityWatch {
 public:
  /// In order of time. Mean specific force over the step to `time`, attitude half-way through it.
  void AddImu(Timestamp time, const Eigen::Vector3d& specific_force_B, const Eigen::Matrix3d& R_WB);
  /// In order of time, up to 2 s late; one without a velocity is ignored.
  void AddGps(const GpsFix& fix);
  /// What was added so far and what comes next belong together no more.
  void Interrupt();
  const GravityAgreement& status() const { return status_; }

 private:
  struct Point {
    Timestamp time;
    Eigen::Vector2d v_mps = Eigen::Vector2d::Zero();  ///< horizontal, in W
  };
  /// What inertia says was gained since the start, at `time`; false where it is not known.
  bool GainedAt(Timestamp time, Eigen::Vector2d& v_mps) const;
  void Judge();

  std::deque<Point> gained_;       ///< by inertia
  std::deque<Point> unexplained_;  ///< r_k
  GravityAgreement status_;
  int off_run_ = 0, fine_run_ = 0;
};

}  // namespace palace
