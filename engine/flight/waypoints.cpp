#include "engine/flight/waypoints.h"

#include <algorithm>
#include <cmath>

#include "engine/core/frames.h"

namespace palace {

namespace {

// Braking at 80 % of the limit leaves the rest for the change of direction.
constexpr double kBrakingShare = 0.8;

}  // namespace

void MovingReference::MoveTowards(const Eigen::Vector3d& waypoint_W, const TravelLimits& limits,
                                  double dt_s) {
  const Eigen::Vector3d way = waypoint_W - p_W;
  const double distance = way.norm();
  const double step = limits.acceleration_mps2 * dt_s;
  // Inside one step of travel the square-root law would chatter; the reference just arrives.
  if (distance <= step * dt_s && v_W.norm() <= 2 * step) {
    p_W = waypoint_W;
    v_W.setZero();
    a_W.setZero();
    return;
  }
  const double speed =
      std::min({limits.max_speed_mps, distance / dt_s,
                std::sqrt(2 * kBrakingShare * limits.acceleration_mps2 * distance)});
  const Eigen::Vector3d change = way * (speed / std::max(distance, 1e-12)) - v_W;
  a_W = change * (std::min(1.0, step / std::max(change.norm(), 1e-12)) / dt_s);
  v_W += a_W * dt_s;
  p_W += v_W * dt_s;
}

double TravelTime(double distance_m, const TravelLimits& limits) {
  const double a = limits.acceleration_mps2, b = kBrakingShare * a;
  const double changing = 1 / (2 * a) + 1 / (2 * b);  // metres, per square of the top speed
  const double top_mps = std::min(limits.max_speed_mps, std::sqrt(distance_m / changing));
  const double cruise_m = distance_m - changing * top_mps * top_mps;
  return top_mps / a + top_mps / b + (top_mps > 0 ? cruise_m / top_mps : 0);
}

double Slew(double from, double to, double step) {
  return from + std::clamp(to - from, -step, step);
}

double SlewAngle(double from_rad, double to_rad, double step_rad) {
  return WrapAngle(from_rad + std::clamp(WrapAngle(to_rad - from_rad), -step_rad, step_rad));
}

}  // namespace palace
