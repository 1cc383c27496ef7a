#include "engine/navigation/gravity_watch.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kWindow_s = 5;
constexpr double kLeastWindow_s = 3;
constexpr std::size_t kLeastFixes = 6;
constexpr double kImuMemory_s = 2;
constexpr double kImuGap_s = 0.1;
constexpr double kSigmas = 6;
constexpr int kOffRun = 2;

}  // namespace

void GravityWatch::Interrupt() {
  gained_.clear();
  unexplained_.clear();
  status_.tilt_deg = NAN;
  off_run_ = fine_run_ = 0;
}

void GravityWatch::AddImu(Timestamp time, const Eigen::Vector3d& specific_force_B,
                          const Eigen::Matrix3d& R_WB) {
  if (!gained_.empty() && SecondsBetween(gained_.back().time, time) > kImuGap_s) {
    Interrupt();
  }
  if (gained_.empty()) {
    gained_.push_back({time});
    return;
  }
  const double dt = SecondsBetween(gained_.back().time, time);
  const Eigen::Vector2d a_mps2 = (R_WB * specific_force_B).head<2>();  // gravity is vertical
  gained_.push_back({time, gained_.back().v_mps + dt * a_mps2});
  while (SecondsBetween(gained_.front().time, time) > kImuMemory_s) {
    gained_.pop_front();
  }
}

bool GravityWatch::GainedAt(Timestamp time, Eigen::Vector2d& v_mps) const {
  const auto after =
      std::lower_bound(gained_.begin(), gained_.end(), time,
                       [](const Point& point, Timestamp at) { return point.time < at; });
  if (after == gained_.end()) {
    // A fix may be a sample newer than the inertial data.
    v_mps = gained_.empty() ? Eigen::Vector2d() : gained_.back().v_mps;
    return !gained_.empty() && SecondsBetween(gained_.back().time, time) <= kImuGap_s;
  }
  if (after->time == time) {
    v_mps = after->v_mps;
    return true;
  }
  if (after == gained_.begin()) {
    return false;
  }
  const Point& before = *std::prev(after);
  const double share = SecondsBetween(before.time, time) / SecondsBetween(before.time, after->time);
  v_mps = before.v_mps + share * (after->v_mps - before.v_mps);
  return true;
}

void GravityWatch::AddGps(const GpsFix& fix) {
  Eigen::Vector2d gained_mps;
  if (!fix.v_WB.allFinite() || (!unexplained_.empty() && fix.time <= unexplained_.back().time) ||
      !GainedAt(fix.time, gained_mps)) {
    return;
  }
  unexplained_.push_back({fix.time, fix.v_WB.head<2>() - gained_mps});
  while (SecondsBetween(unexplained_.front().time, fix.time) > kWindow_s) {
    unexplained_.pop_front();
  }
  Judge();
}

void GravityWatch::Judge() {
  const Timestamp start = unexplained_.front().time;
  const double n = static_cast<double>(unexplained_.size());
  status_.tilt_deg = NAN;
  if (unexplained_.size() < kLeastFixes ||
      SecondsBetween(start, unexplained_.back().time) < kLeastWindow_s) {
    return;
  }
  double mean_s = 0;
  Eigen::Vector2d mean_mps = Eigen::Vector2d::Zero();
  for (const Point& point : unexplained_) {
    mean_s += SecondsBetween(start, point.time) / n;
    mean_mps += point.v_mps / n;
  }
  double spread_s2 = 0, scatter_m2ps2 = 0;
  Eigen::Vector2d slope_mps2 = Eigen::Vector2d::Zero();
  for (const Point& point : unexplained_) {
    const double t = SecondsBetween(start, point.time) - mean_s;
    spread_s2 += t * t;
    slope_mps2 += t * (point.v_mps - mean_mps);
  }
  slope_mps2 /= spread_s2;
  for (const Point& point : unexplained_) {
    const double t = SecondsBetween(start, point.time) - mean_s;
    scatter_m2ps2 += (point.v_mps - mean_mps - t * slope_mps2).squaredNorm();
  }
  const double sigma_mps2 = std::sqrt(scatter_m2ps2 / (2 * (n - 2)) / spread_s2);
  status_.tilt_deg = Deg(std::atan(slope_mps2.norm() / kStandardGravity_mps2));
  const bool off =
      status_.tilt_deg > GravityAgreement::kLimit_deg && slope_mps2.norm() > kSigmas * sigma_mps2;
  off_run_ = off ? off_run_ + 1 : 0;
  fine_run_ = off ? 0 : fine_run_ + 1;
  status_.off = status_.off ? fine_run_ < GravityAgreement::kFineFixes : off_run_ >= kOffRun;
}

}  // namespace palace
