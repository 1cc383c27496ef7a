#include "engine/navigation/handover.h"

#include <algorithm>
#include <cmath>

#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kSettle_s = 2.0;
constexpr double kMaxVelocityGap_mps = 0.3;
constexpr double kMaxSilence_s = 0.5;
constexpr int kMaxRejected = 5;
constexpr double kStampSlack_s = 1e-3;
// Residuals by a filter that widens what fixes state are always as large as they should be.
constexpr double kRoughest = 5;

}  // namespace

void Handover::Start(Timestamp time) {
  const bool allowed = allowed_;
  *this = Handover();
  allowed_ = allowed;
  state_ = State::kSettling;
  started_ = time;
  settled_since_ = time;
  last_accepted_ = time;
  reason_ = "waiting for the first vision position";
}

void Handover::Stop() {
  const bool allowed = allowed_;
  *this = Handover();
  allowed_ = allowed;
}

void Handover::AddFix(const HandoverSample& sample) {
  if (!sample.accepted) {
    ++rejected_in_row_;
    return;
  }
  rejected_in_row_ = 0;
  const bool gap = SecondsBetween(last_accepted_, sample.time) > kMaxSilence_s + kStampSlack_s;
  if (samples_.empty() || gap) {
    samples_.clear();
    settled_since_ = sample.time;
  }
  last_accepted_ = std::max(last_accepted_, sample.time);
  samples_.push_back(sample);
  while (SecondsBetween(samples_.front().time, last_accepted_) > kSettle_s + kStampSlack_s) {
    samples_.pop_front();
  }
}

bool Handover::Healthy(Timestamp now) const {
  return state_ != State::kGps && !samples_.empty() && rejected_in_row_ < kMaxRejected &&
         SecondsBetween(last_accepted_, now) <= kMaxSilence_s + kStampSlack_s;
}

std::string Handover::WaitingFor(Timestamp now) const {
  if (samples_.empty()) {
    return "waiting for the first vision position";
  }
  if (rejected_in_row_ >= kMaxRejected) {
    return WithNumbers("vision rejected %.0f times in a row", rejected_in_row_, 0);
  }
  const double silence_s = SecondsBetween(last_accepted_, now);
  if (silence_s > kMaxSilence_s + kStampSlack_s) {
    return WithNumbers("no vision position for %.1f s", silence_s, 0);
  }
  const double settled_s = SecondsBetween(settled_since_, last_accepted_);
  if (settled_s < kSettle_s - kStampSlack_s) {
    return WithNumbers("vision settling, %.1f of %.1f s", settled_s, kSettle_s);
  }
  double sum = 0;
  for (const HandoverSample& sample : samples_) {
    sum += sample.nis;
  }
  const double count = static_cast<double>(samples_.size());
  const double bound = 3 + 3 * std::sqrt(6 / count);
  if (sum / count > bound) {
    return WithNumbers("vision residuals too large, %.1f over %.1f", sum / count, bound);
  }
  const double rough = std::sqrt(samples_.back().variance_factor);
  if (rough > kRoughest) {
    return WithNumbers("vision scatters %.1f times as stated, limit %.1f", rough, kRoughest);
  }
  const double gap_mps = samples_.back().velocity_gap_mps;
  if (!(gap_mps < kMaxVelocityGap_mps)) {
    return WithNumbers("vision and GPS velocity differ by %.2f m/s, limit %.2f m/s", gap_mps,
                       kMaxVelocityGap_mps);
  }
  return {};
}

bool Handover::Advance(Timestamp now) {
  if (state_ == State::kGps) {
    return false;
  }
  const std::string waiting = WaitingFor(now);
  if (state_ == State::kVision) {
    reason_ = Healthy(now) ? std::string() : waiting;
    return false;
  }
  if (!waiting.empty()) {
    state_ = State::kSettling;
    reason_ = waiting;
    return false;
  }
  if (!allowed_) {
    state_ = State::kReady;
    reason_ = "ready, waiting for an accepted approval";
    return false;
  }
  state_ = State::kVision;
  reason_.clear();
  return true;
}

}  // namespace palace
