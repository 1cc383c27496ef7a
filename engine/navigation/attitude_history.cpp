#include "engine/navigation/attitude_history.h"

#include <algorithm>
#include <iterator>

#include "engine/core/rotation_vector.h"

namespace palace {
namespace {

constexpr double kWindow_s = 2.0;
constexpr double kMaxAhead_s = 0.5;

VehiclePose TurnedOn(const VehiclePose& pose, double seconds) {
  VehiclePose ahead = pose;
  ahead.time = AddSeconds(pose.time, seconds);
  ahead.X_WB.R = pose.X_WB.R * RotationFromVector(pose.angular_rate_B * seconds);
  ahead.X_WB.p += pose.v_WB * seconds;
  return ahead;
}

VehiclePose Between(const VehiclePose& a, const VehiclePose& b, Timestamp time) {
  const double share = SecondsBetween(a.time, time) / SecondsBetween(a.time, b.time);
  const Eigen::Quaterniond q_a(a.X_WB.R);
  const Eigen::Quaterniond q_b(b.X_WB.R);
  VehiclePose pose;
  pose.time = time;
  pose.X_WB.R = q_a.slerp(share, q_b).normalized().toRotationMatrix();
  pose.X_WB.p = a.X_WB.p + share * (b.X_WB.p - a.X_WB.p);
  pose.v_WB = a.v_WB + share * (b.v_WB - a.v_WB);
  pose.angular_rate_B = a.angular_rate_B + share * (b.angular_rate_B - a.angular_rate_B);
  pose.sigmas = {std::max(a.sigmas.position_m, b.sigmas.position_m),
                 std::max(a.sigmas.attitude_rad, b.sigmas.attitude_rad)};
  return pose;
}

}  // namespace

void AttitudeHistory::Add(const VehiclePose& pose) {
  if (!pose.X_WB.R.allFinite() || !pose.X_WB.p.allFinite() || !pose.v_WB.allFinite() ||
      !pose.angular_rate_B.allFinite()) {
    return;
  }
  if (!poses_.empty() && SecondsBetween(pose.time, poses_.back().time) > kWindow_s) {
    return;
  }
  const auto place = std::lower_bound(poses_.begin(), poses_.end(), pose.time,
                                      [](const VehiclePose& p, Timestamp t) { return p.time < t; });
  if (place != poses_.end() && place->time == pose.time) {
    *place = pose;
  } else {
    poses_.insert(place, pose);
  }
  while (SecondsBetween(poses_.front().time, poses_.back().time) > kWindow_s) {
    poses_.pop_front();
  }
}

std::optional<VehiclePose> AttitudeHistory::At(Timestamp time) const {
  if (poses_.empty()) {
    return std::nullopt;
  }
  if (time >= poses_.back().time) {
    return TurnedOn(poses_.back(), std::min(SecondsBetween(poses_.back().time, time), kMaxAhead_s));
  }
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), time,
                                      [](Timestamp t, const VehiclePose& p) { return t < p.time; });
  if (after == poses_.begin()) {
    return poses_.front();
  }
  return Between(*std::prev(after), *after, time);
}

}  // namespace palace
