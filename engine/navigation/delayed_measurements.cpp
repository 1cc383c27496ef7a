#include "engine/navigation/delayed_measurements.h"

#include <algorithm>
#include <iterator>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr double kMaxGap_s = 0.1;  // an IMU silent for longer has stopped

}  // namespace

void DelayedMeasurements::Start(const InertialState& state, const ProcessNoise& noise) {
  noise_ = noise;
  Entry first;
  first.input.coasting = true;
  first.after = state;
  entries_.assign(1, first);
}

void DelayedMeasurements::AddInput(Timestamp time, const InertialInput& input) {
  PALACE_CHECK(!entries_.empty());
  if (time <= newest()) {
    return;
  }
  const double gap_s = SecondsBetween(newest(), time);
  if (gap_s > kMaxGap_s) {
    // What happened in the gap is unknown: coast through it, then use the sample for its own step.
    Coast(AddSeconds(time, -0.01));
  }
  Entry entry;
  entry.input = input;
  entry.after = entries_.back().after;
  PredictState(entry.after, time, input, noise_);
  entries_.push_back(std::move(entry));
  Forget();
}

void DelayedMeasurements::Coast(Timestamp time) {
  if (time <= newest()) {
    return;
  }
  Entry entry;
  entry.input.coasting = true;
  entry.after = entries_.back().after;
  PredictState(entry.after, time, entry.input, noise_);
  entries_.push_back(std::move(entry));
}

std::size_t DelayedMeasurements::LastAtOrBefore(Timestamp time) const {
  const auto after = std::upper_bound(entries_.begin(), entries_.end(), time,
                                      [](Timestamp t, const Entry& e) { return t < e.after.time; });
  PALACE_CHECK(after != entries_.begin());
  return static_cast<std::size_t>(std::distance(entries_.begin(), after)) - 1;
}

InertialInput DelayedMeasurements::InputAfter(const Entry& entry, Timestamp time) const {
  // Beyond the newest sample its acceleration is held for a short while, then nothing is known.
  InertialInput input = entry.input;
  if (SecondsBetween(entry.after.time, time) > kMaxGap_s) {
    input.coasting = true;
  }
  return input;
}

std::optional<Innovation> DelayedMeasurements::Insert(const PositionMeasurement& fix) {
  PALACE_CHECK(!entries_.empty());
  if (fix.time < entries_.front().after.time) {
    return std::nullopt;
  }
  const std::size_t before = LastAtOrBefore(fix.time);
  // The inertial step that spans the stamp is cut in two at it.
  Entry entry;
  entry.input = before + 1 < entries_.size() ? entries_[before + 1].input
                                             : InputAfter(entries_[before], fix.time);
  entry.fix = fix;
  entry.after = entries_[before].after;
  PredictState(entry.after, fix.time, entry.input, noise_);
  entry.after.time = fix.time;
  const Innovation innovation = UpdateState(entry.after, fix);
  if (!innovation.within_gate) {
    return innovation;  // leaves no trace
  }
  const auto place = entries_.begin() + static_cast<std::ptrdiff_t>(before) + 1;
  entries_.insert(place, entry);
  for (std::size_t i = before + 2; i < entries_.size(); ++i) {
    Entry& later = entries_[i];
    const Timestamp time = later.after.time;
    later.after = entries_[i - 1].after;
    PredictState(later.after, time, later.input, noise_);
    if (later.fix) {
      (void)UpdateState(later.after, *later.fix);
    }
  }
  Forget();
  return innovation;
}

void DelayedMeasurements::Shift(const Eigen::Vector3d& by_W) {
  for (Entry& entry : entries_) {
    entry.after.x.head<3>() += by_W;
    if (entry.fix) {
      entry.fix->p_WB += by_W;
    }
  }
}

InertialState DelayedMeasurements::StateAt(Timestamp time) const {
  PALACE_CHECK(!entries_.empty());
  if (time <= entries_.front().after.time) {
    return entries_.front().after;
  }
  const std::size_t before = LastAtOrBefore(time);
  InertialState state = entries_[before].after;
  if (before + 1 < entries_.size()) {
    PredictState(state, time, entries_[before + 1].input, noise_);
    return state;
  }
  const Timestamp held = std::min(time, AddSeconds(state.time, kMaxGap_s));
  PredictState(state, held, entries_[before].input, noise_);
  InertialInput unknown;
  unknown.coasting = true;
  PredictState(state, time, unknown, noise_);
  return state;
}

void DelayedMeasurements::Forget() {
  while (entries_.size() > 1 && SecondsBetween(entries_.front().after.time, newest()) > kWindow_s) {
    entries_.pop_front();
  }
}

}  // namespace palace
