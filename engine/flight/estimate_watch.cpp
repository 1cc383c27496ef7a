#include "engine/flight/estimate_watch.h"

#include <cmath>

#include "engine/core/text.h"

namespace palace {
namespace {

/// Estimates are of the past by less than this.
constexpr double kOwnMemory_s = 1;

}  // namespace

std::string EstimateWatch::Begin(const Eigen::Vector3d& p_vision_WB,
                                 const Eigen::Vector3d& p_own_WB) {
  difference_.clear();
  first_.reset();
  const double apart_m = (p_vision_WB - p_own_WB).norm();
  return apart_m <= kApart_m
             ? ""
             : WithNumbers("The position estimate is %.1f m from the vehicle's own, limit %.0f m",
                           apart_m, kApart_m);
}

void EstimateWatch::Propagate(Timestamp now, const Eigen::Vector3d& v_WB) {
  const double dt = own_.empty() ? 0 : SecondsBetween(own_.back().time, now);
  own_.push_back({now, own_.empty() ? Eigen::Vector3d::Zero().eval()
                                    : Eigen::Vector3d(own_.back().p_W + dt * v_WB)});
  while (SecondsBetween(own_.front().time, now) > kOwnMemory_s) {
    own_.pop_front();
  }
}

const EstimateWatch::Point* EstimateWatch::OwnAt(Timestamp time) const {
  const Point* found = nullptr;
  for (const Point& point : own_) {
    if (point.time > time) {
      break;
    }
    found = &point;
  }
  return found;
}

std::string EstimateWatch::Judge(const PositionEstimate& estimate) {
  const Point* own = OwnAt(estimate.time);
  if (own == nullptr) {
    return {};
  }
  Point now{estimate.time, estimate.p_WB - own->p_W};
  if (!difference_.empty()) {
    const Point& last = difference_.back();
    const double keep = std::exp(-SecondsBetween(last.time, now.time) / kAverage_s);
    now.p_W = keep * last.p_W + (1 - keep) * now.p_W;
  }
  while (!difference_.empty() && SecondsBetween(difference_.front().time, now.time) > kMemory_s) {
    difference_.pop_front();
  }
  difference_.push_back(now);
  first_ = first_.value_or(now);
  const double sum_m = (now.p_W - first_->p_W).norm();
  if (sum_m > kSum_m) {
    return WithNumbers(
        "The position estimate moved %.2f m against the vehicle's own solution since it took over, "
        "limit %.2f m",
        sum_m, kSum_m);
  }
  for (const Point& then : difference_) {
    const double span_s = SecondsBetween(then.time, now.time);
    const double apart_m = (now.p_W - then.p_W).norm();
    const double limit_m = kStep_m + kDrift_mps * span_s;
    if (apart_m > limit_m) {
      return WithNumbers(
          "The position estimate moved %.2f m in %.1f s against the vehicle's own solution, limit "
          "%.2f m",
          apart_m, span_s, limit_m);
    }
  }
  return {};
}

}  // namespace palace
