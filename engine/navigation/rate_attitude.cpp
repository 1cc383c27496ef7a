#include "engine/navigation/rate_attitude.h"

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kPull_s = 20;
constexpr double kMostApart_rad = Rad(0.5);
constexpr double kGap_s = 0.25;

Eigen::Matrix3d Turned(const Eigen::Matrix3d& R, double angle_rad, const Eigen::Vector3d& axis) {
  return R * Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
}

}  // namespace

void RateAttitude::Add(const VehiclePose& pose) {
  if (!pose.X_WB.R.allFinite() || !pose.angular_rate_B.allFinite()) {
    return;
  }
  if (carried_.empty() || SecondsBetween(carried_.newest().time, pose.time) > kGap_s) {
    Reset();
    start_ = pose.time;
    carried_.Add(pose);
    return;
  }
  const VehiclePose& last = carried_.newest();
  const double dt = SecondsBetween(last.time, pose.time);
  if (!(dt > 0)) {
    return;
  }
  VehiclePose next = pose;
  const Eigen::Vector3d turn = 0.5 * dt * (last.angular_rate_B + pose.angular_rate_B);
  next.X_WB.R = Turned(last.X_WB.R, turn.norm(), turn.stableNormalized());
  const Eigen::AngleAxisd apart(Eigen::Matrix3d(next.X_WB.R.transpose() * pose.X_WB.R));
  apart_rad_ = apart.angle();
  next.X_WB.R = Turned(next.X_WB.R, dt / kPull_s * apart.angle(), apart.axis());
  carried_.Add(next);
}

std::optional<Eigen::Matrix3d> RateAttitude::At(Timestamp time, double over_s) const {
  const std::optional<VehiclePose> pose = carried_.At(time);
  if (!pose || apart_rad_ > kMostApart_rad || SecondsBetween(start_, time) < over_s) {
    return std::nullopt;
  }
  return pose->X_WB.R;
}

}  // namespace palace
