#include "engine/simulation/pose_history.h"

#include <algorithm>

#include "engine/core/check.h"

namespace palace {
namespace {

RigidTransform Between(const RigidTransform& a, const RigidTransform& b, double share) {
  const Eigen::Quaterniond turned = Eigen::Quaterniond(a.R).slerp(share, Eigen::Quaterniond(b.R));
  return {turned.toRotationMatrix(), a.p + share * (b.p - a.p)};
}

VehiclePose Carried(VehiclePose pose, Timestamp time) {
  const double dt_s = SecondsBetween(pose.time, time);
  const Eigen::Vector3d turn = dt_s * pose.angular_rate_B;
  if (turn.norm() > 0) {
    pose.X_WB.R = pose.X_WB.R * Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
  }
  pose.X_WB.p += dt_s * pose.v_WB;
  pose.time = time;
  return pose;
}

}  // namespace

void PoseHistory::Add(const RigidTransform& X_WB, const VehiclePose& told) {
  entries_.push_back({X_WB, told});
  while (SecondsBetween(entries_.front().told.time, told.time) > kLength_s) {
    entries_.pop_front();
  }
}

std::size_t PoseHistory::Find(Timestamp time) const {
  PALACE_CHECK(!entries_.empty());
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), time,
                       [](const Entry& entry, Timestamp t) { return entry.told.time < t; });
  return std::min(static_cast<std::size_t>(found - entries_.begin()), entries_.size() - 1);
}

RigidTransform PoseHistory::TrueAt(Timestamp time) const {
  const std::size_t i = Find(time);
  const Entry& after = entries_[i];
  if (i == 0 || time >= after.told.time) {
    return after.X_WB;
  }
  const Entry& before = entries_[i - 1];
  return Between(
      before.X_WB, after.X_WB,
      SecondsBetween(before.told.time, time) / SecondsBetween(before.told.time, after.told.time));
}

VehiclePose PoseHistory::ToldAt(Timestamp time, double delay_s) const {
  const Timestamp told = AddSeconds(entries_.back().told.time, -delay_s);
  std::size_t i = Find(std::min(time, told));
  while (i > 0 && entries_[i].told.time > std::min(time, told)) {
    --i;
  }
  const VehiclePose& pose = entries_[i].told;
  return pose.time == time ? pose : Carried(pose, time);
}

}  // namespace palace
