#include "engine/navigation/gps_watch.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr double kWindow_s = 5;
constexpr double kGap_s = 1;  // velocities further apart tell no way between them
constexpr double kSigmas = 6;
constexpr double kGate = 19.8;  // the filter's, of six degrees of freedom
constexpr double kSettled_s = 10;
constexpr double kLeastVariance_m2 = 1e-6;
constexpr int kOffRun = 2;

/// A sigma that is not known counts as 0.
Eigen::Vector3d KnownSigmaOf(const GpsFix& fix) {
  const auto known = [](double sigma_m) {
    return std::isfinite(sigma_m) ? std::max(0.0, sigma_m) : 0.0;
  };
  const double horizontal_m = known(fix.sigma_horizontal_m);
  return {horizontal_m, horizontal_m, known(fix.sigma_vertical_m)};
}

/// Any axis beyond the limit and beyond chance.
bool Beyond(const Eigen::Vector3d& difference_m, const Eigen::Vector3d& sigma_m, double limit_m) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(difference_m[axis]) > std::max(limit_m, kSigmas * sigma_m[axis])) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool GpsWatch::DriftsAt(const GpsFix& fix) {
  if (!fix.v_WB.allFinite()) {
    recent_.clear();
    return false;
  }
  Point point{fix};
  if (!recent_.empty()) {
    const Point& last = recent_.back();
    const double dt = SecondsBetween(last.fix.time, fix.time);
    if (dt > kGap_s) {
      recent_.clear();
    } else {
      point.travelled_m = last.travelled_m + 0.5 * dt * (last.fix.v_WB + fix.v_WB);
    }
  }
  recent_.push_back(point);
  while (SecondsBetween(recent_.front().fix.time, fix.time) > kWindow_s) {
    recent_.pop_front();
  }
  const Point& first = recent_.front();
  const Eigen::Vector3d unexplained =
      (fix.p_WB - first.fix.p_WB) - (point.travelled_m - first.travelled_m);
  return Beyond(unexplained, std::sqrt(2.0) * KnownSigmaOf(fix), GpsAgreement::kDrift_m);
}

void GpsWatch::Add(const GpsFix& fix, const std::optional<FilterEstimate>& predicted) {
  if (!fix.p_WB.allFinite() || (newest_ != Timestamp{} && fix.time <= newest_)) {
    return;
  }
  newest_ = fix.time;
  const bool drifts = DriftsAt(fix);
  bool jumped = false;
  status_.off_m = NAN;
  if (predicted) {
    const Eigen::Vector3d innovation = fix.p_WB - predicted->p_WB;
    const Eigen::Vector3d variance =
        (KnownSigmaOf(fix).cwiseAbs2() + predicted->sigma_p_m.cwiseAbs2())
            .cwiseMax(kLeastVariance_m2);
    status_.off_m = innovation.norm();
    jumped = status_.off_m > GpsAgreement::kJump_m &&
             innovation.cwiseAbs2().cwiseQuotient(variance).sum() > kGate;
  }
  const bool off = drifts || jumped;
  off_run_ = off ? off_run_ + 1 : 0;
  fine_run_ = off ? 0 : fine_run_ + 1;
  status_.drifts = drifts && !jumped;
  status_.off = status_.off ? fine_run_ < GpsAgreement::kFineFixes : off_run_ >= kOffRun;
  if (!status_.off || drifts) {
    consistent_since_.reset();
  } else if (!consistent_since_) {
    consistent_since_ = fix.time;
  }
}

bool GpsWatch::SettledElsewhere() const {
  return consistent_since_ && SecondsBetween(*consistent_since_, newest_) >= kSettled_s;
}

}  // namespace palace
