#include "engine/core/vehicle_clock.h"

#include <algorithm>
#include <utility>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr double kWindow_s = 1;
constexpr std::size_t kWindows = 60;
constexpr std::size_t kLeastWindows = 10;  ///< no drift is told from fewer
constexpr double kSure_s = 1;
constexpr int kSureAfter = 10;
constexpr double kAgree_s = 0.2;
constexpr double kSameDelay_s = 0.05;
constexpr double kJitterShare = 0.05;

double Seconds(std::int64_t us) { return static_cast<double>(us) * 1e-6; }

double Apart_s(std::int64_t a_us, std::int64_t b_us) {
  return std::abs(Seconds(SaturatedDifference(a_us, b_us)));
}

}  // namespace

void VehicleClock::Begin(std::int64_t offset_us, double arrival_s) {
  known_ = true;
  offset_us_ = offset_us;
  began_s_ = fitted_s_ = followed_s_ = arrival_s;
  fitted_ = 1;
  suspect_.reset();
  windows_.clear();
  late_.reset();
  window_ = {arrival_s, offset_us};
  jitter_s_ = NAN;
  newest_vote_ = {std::numeric_limits<std::int64_t>::min()};
}

bool VehicleClock::estimating() const {
  return !known_ || fitted_ < kSureAfter || fitted_s_ - began_s_ < kSure_s;
}

Timestamp VehicleClock::At(double station_s) const {
  PALACE_CHECK(known_);
  return {SaturatedSum(offset_us_, Microseconds(station_s))};
}

VehicleClock::Heard VehicleClock::Judge(std::int64_t offset_us, double arrival_s) const {
  const double lead_s = Seconds(SaturatedDifference(offset_us, offset_us_));
  const double ahead_s = estimating() || simulated_ ? kAheadUnsure_s : kAheadLimit_s;
  if (lead_s > ahead_s + kDriftLimit * (arrival_s - fitted_s_)) {
    return Heard::kAhead;
  }
  return lead_s < -kBehindLimit_s ? Heard::kBehind : Heard::kFits;
}

bool VehicleClock::CanBe(Timestamp stamp, double arrival_s) const {
  return !known_ ||
         Judge(SaturatedDifference(stamp.us, Microseconds(arrival_s)), arrival_s) == Heard::kFits;
}

VehicleClock::Heard VehicleClock::Hear(Timestamp stamp, double arrival_s, bool votes) {
  const std::int64_t offset_us = SaturatedDifference(stamp.us, Microseconds(arrival_s));
  if (!known_) {
    Begin(offset_us, arrival_s);
    voted_ = votes;
    return Heard::kFits;
  }
  if (const Heard verdict = Judge(offset_us, arrival_s); verdict != Heard::kFits) {
    return Doubt(offset_us, arrival_s, votes, verdict);
  }
  if (!votes) {
    return Heard::kFits;
  }
  if (!std::exchange(voted_, true)) {
    // What began it was of anybody.
    const bool far = Apart_s(offset_us, offset_us_) >= kLate_s;
    if (far) {
      return Step(offset_us, arrival_s);
    }
    Begin(offset_us, arrival_s);
    return Heard::kFits;
  }
  if ((SecondsBetween(stamp, newest_vote_) > kBackLimit_s || IsNearerSuspect(offset_us))) {
    // Late and out of order, or the first of a clock that went back: believed, but not followed.
    return Doubt(offset_us, arrival_s, votes, Heard::kFits);
  }
  suspect_.reset();
  newest_vote_ = std::max(newest_vote_, stamp);
  const double before_s = step_s_;
  step_s_ = 0;
  Follow(offset_us, arrival_s);
  if (step_s_ != 0) {
    return Heard::kStepped;
  }
  step_s_ = before_s;
  return Heard::kFits;
}

bool VehicleClock::IsNearerSuspect(std::int64_t offset_us) const {
  return suspect_ && Apart_s(offset_us, suspect_->offset_us) < Apart_s(offset_us, offset_us_);
}

VehicleClock::Heard VehicleClock::Doubt(std::int64_t offset_us, double arrival_s, bool votes,
                                        Heard verdict) {
  const bool deaf = arrival_s - fitted_s_ > kDeaf_s;
  if (!votes && !deaf) {
    return verdict;
  }
  const bool agrees =
      suspect_ && (simulated_ || Apart_s(offset_us, suspect_->offset_us) <= kAgree_s);
  if (!agrees) {
    suspect_ = Suspect{offset_us, arrival_s, arrival_s, 0};
  }
  suspect_->offset_us = std::max(suspect_->offset_us, offset_us);
  suspect_->last_s = arrival_s;
  ++suspect_->votes;
  const bool enough =
      suspect_->votes >= kVotes && suspect_->last_s - suspect_->first_s >= kVoteSpan_s;
  return enough ? Step(suspect_->offset_us, arrival_s) : verdict;
}

VehicleClock::Heard VehicleClock::Step(std::int64_t offset_us, double arrival_s) {
  step_s_ = Seconds(SaturatedDifference(offset_us, offset_us_));
  Begin(offset_us, arrival_s);
  return Heard::kStepped;
}

void VehicleClock::Follow(std::int64_t offset_us, double arrival_s) {
  const double passed_s = std::max(0.0, arrival_s - followed_s_);
  fitted_s_ = followed_s_ = arrival_s;
  ++fitted_;
  const double pace = simulated_ ? 1 - kSlowestPace : kDriftLimit;
  const std::int64_t fallen_us = SaturatedDifference(offset_us_, Microseconds(pace * passed_s));
  const double queued_s = arrival_s < queue_until_s_ ? stalled_s_ : 0;
  const std::int64_t excused_us = SaturatedSum(offset_us, Microseconds(queued_s));
  offset_us_ = std::max({offset_us, fallen_us, std::min(offset_us_, excused_us)});
  const double delay_s = Seconds(SaturatedDifference(offset_us_, offset_us));
  jitter_s_ = std::isnan(jitter_s_) ? delay_s : jitter_s_ + kJitterShare * (delay_s - jitter_s_);
  if (arrival_s - window_.start_s < kWindow_s) {
    window_.offset_us = std::max(window_.offset_us, offset_us);
    return;
  }
  const Window done = window_;
  window_ = {arrival_s, offset_us};
  windows_.push_back(done);
  if (windows_.size() > kWindows) {
    windows_.pop_front();
  }
  if (const std::int64_t delay_us = StandingDelay_us(done); delay_us != 0) {
    (void)Step(SaturatedDifference(offset_us_, delay_us), arrival_s);
  }
}

std::int64_t VehicleClock::StandingDelay_us(const Window& done) {
  const std::int64_t delay_us = SaturatedDifference(offset_us_, done.offset_us);
  if (simulated_ || Seconds(delay_us) < kLate_s) {
    late_.reset();
    return 0;
  }
  if (!late_ || Apart_s(late_->offset_us, done.offset_us) > kSameDelay_s) {
    late_ = done;
  }
  return done.start_s - late_->start_s >= kLateFor_s ? delay_us : 0;
}

double VehicleClock::drift_ppm() const {
  if (windows_.size() < kLeastWindows || simulated_) {
    return NAN;
  }
  // The best of each third: delays only ever take away, so the best is the least disturbed.
  const std::size_t third = windows_.size() / 3;
  const auto best = [](auto from, auto to) {
    return std::max_element(
        from, to, [](const Window& a, const Window& b) { return a.offset_us < b.offset_us; });
  };
  const auto first = best(windows_.begin(), windows_.begin() + static_cast<std::ptrdiff_t>(third));
  const auto last = best(windows_.end() - static_cast<std::ptrdiff_t>(third), windows_.end());
  return 1e6 * Seconds(SaturatedDifference(last->offset_us, first->offset_us)) /
         (last->start_s - first->start_s);
}

}  // namespace palace
