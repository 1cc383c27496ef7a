// A reference point that travels to a waypoint with limited speed and acceleration, so that the
// position loop never sees a step: it leaves with its present velocity and arrives at rest.
//   wanted speed = min(max_speed, sqrt(2 a distance)), change of velocity at most a dt
#pragma once

#include <Eigen/Dense>

namespace palace {

struct TravelLimits {
  double max_speed_mps = 2.0;
  double acceleration_mps2 = 0.4;
};

struct MovingReference {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d a_W = Eigen::Vector3d::Zero();  ///< of the last step, for feed-forward

  /// One step of dt_s towards the waypoint.
  void MoveTowards(const Eigen::Vector3d& waypoint_W, const TravelLimits& limits, double dt_s);
};

/// Seconds that a MovingReference takes over the distance, from rest to rest.
double TravelTime(double distance_m, const TravelLimits& limits);

/// `from` moved towards `to` by at most `step`; angles the short way round.
double SlewAngle(double from_rad, double to_rad, double step_rad);
double Slew(double from, double to, double step);

}  // namespace palace
