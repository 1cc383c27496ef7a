#include "engine/mission/watch/energy_watch.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kLine_s = 10;  // shorter, the line leans as its noise does

}  // namespace

void EnergyWatch::Forget() {
  samples_.clear();
  line_ = NAN;
  left_ = {};
}

void EnergyWatch::Fit(Timestamp now) {
  double mean_s = 0, mean = 0;
  for (const Sample& sample : samples_) {
    mean_s -= SecondsBetween(sample.time, now);
    mean += sample.share;
  }
  const auto n = static_cast<double>(samples_.size());
  mean_s /= n;
  mean /= n;
  double squares = 0, products = 0;
  for (const Sample& sample : samples_) {
    const double t_s = -SecondsBetween(sample.time, now) - mean_s;
    squares += t_s * t_s;
    products += t_s * (sample.share - mean);
  }
  const double span_s = SecondsBetween(samples_.front().time, now);
  const double rate = span_s >= kLine_s ? -products / squares : 0;
  line_ = mean + rate * mean_s;
  left_.lasts_s = rate * span_s >= kLeastFall ? std::max(0.0, line_ / rate) : NAN;
}

void EnergyWatch::Update(double share, Timestamp now) {
  if (!std::isfinite(share)) {
    left_ = {};
    return;
  }
  if (std::abs(share - line_) > kJump || (!samples_.empty() && now < samples_.back().time)) {
    Forget();
  }
  left_.share = share;
  if (!samples_.empty() && SecondsBetween(samples_.back().time, now) < kEvery_s) {
    return;
  }
  samples_.push_back({now, share});
  while (SecondsBetween(samples_.front().time, now) > kWindow_s) {
    samples_.pop_front();
  }
  Fit(now);
}

EnergyLeft EnergyWatch::Left() const { return left_; }

}  // namespace palace
