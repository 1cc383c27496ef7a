#include "engine/runtime/channel_monitor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "engine/model/channel_age.h"

namespace palace {
namespace {

constexpr double kLostAfterPeriods = 1.5;
constexpr std::size_t kPeriodsKept = 256;
constexpr std::size_t kLeastPeriods = 20;  ///< no beat is told from fewer
constexpr double kBeatQuantile = 0.4;

}  // namespace

ChannelMonitor::ChannelMonitor() { Reset(); }

void ChannelMonitor::Reset() {
  watches_ = {};
  const auto expect = [&](ChannelId channel, double hz) { Of(channel).expected_hz = hz; };
  expect(ChannelId::kCameraLeft, 10);
  expect(ChannelId::kCameraRight, 10);
  expect(ChannelId::kVehiclePose, 50);
  expect(ChannelId::kImu, 100);
  expect(ChannelId::kGps, 5);
  expect(ChannelId::kLaserRange, 20);
  expect(ChannelId::kVehicleStatus, 10);
  expect(ChannelId::kPositionEstimate, 10);
  gps_sigma_m_ = 0;
}

void ChannelMonitor::RestoreHeard(
    const std::array<std::optional<Timestamp>, kChannelCount>& heard) {
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    watches_[i].heard_before = heard[i];
  }
}

void ChannelMonitor::Saw(ChannelId channel, Timestamp stamp) {
  Watch& watch = Of(channel);
  if (watch.count > 0) {
    const double period_s = SecondsBetween(watch.last, stamp);
    if (period_s <= 0) {
      return;
    }
    const int came = 1 + watch.overtaken;
    for (int i = 0; i < std::min<int>(came, kPeriodsKept); ++i) {
      watch.periods_s.push_back(period_s / came);
    }
    while (watch.periods_s.size() > kPeriodsKept) {
      watch.periods_s.pop_front();
    }
    const double periods = period_s * watch.expected_hz;
    if (periods > watch.overtaken + kLostAfterPeriods) {
      watch.lost += static_cast<std::uint64_t>(std::lround(periods) - came);
    }
  }
  watch.last = stamp;
  watch.count += 1 + static_cast<std::uint64_t>(std::exchange(watch.overtaken, 0));
}

double ChannelMonitor::Watch::Rate_hz() const {
  double span_s = 0, got = 0;
  for (auto p = periods_s.rbegin(); p != periods_s.rend() && span_s < kRateWindow_s; ++p) {
    const double part = std::min(1.0, (kRateWindow_s - span_s) / *p);
    span_s += part * *p;
    got += part;
  }
  return span_s > 0 ? got / span_s : 0;
}

double ChannelMonitor::Watch::LostShare() const {
  if (periods_s.size() < kLeastPeriods) {
    return NAN;
  }
  std::vector<double> sorted(periods_s.begin(), periods_s.end());
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(
                                          kBeatQuantile * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), place, sorted.end());
  double span_s = 0, got = 0;
  bool was_silent = false;
  for (auto p = periods_s.rbegin(); p != periods_s.rend() && span_s < kLossWindow_s; ++p) {
    // One silence is an outage, told while it lasted: what comes since loses nothing. More are
    // loss.
    if (!was_silent && StateAt(*p, expected_hz) == ChannelHealth::State::kStale) {
      was_silent = true;
      continue;
    }
    span_s += *p;
    ++got;
  }
  return std::max(0.0, 1 - got * *place / span_s);
}

void ChannelMonitor::Add(const FrameBundle& bundle, bool has_vehicle) {
  has_vehicle_ = has_vehicle;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    watches_[i].overtaken += bundle.arrival.overtaken[i];
  }
  if (bundle.rig) {
    for (const ChannelId channel :
         {ChannelId::kCameraLeft, ChannelId::kCameraRight, ChannelId::kPositionEstimate}) {
      Of(channel).expected_hz = bundle.rig->rate_hz;
    }
    if (!has_vehicle) {
      Of(ChannelId::kVehiclePose).expected_hz = bundle.rig->rate_hz;  // of RIG.toml, once a pair
    }
  }
  if (bundle.stereo) {
    if (!bundle.stereo->left.empty()) {
      Saw(ChannelId::kCameraLeft, bundle.stereo->time);
    }
    if (!bundle.stereo->right.empty()) {
      Saw(ChannelId::kCameraRight, bundle.stereo->time);
    }
  }
  if (bundle.arrival.left_alone) {
    Saw(ChannelId::kCameraLeft, *bundle.arrival.left_alone);
  }
  if (bundle.arrival.right_alone) {
    Saw(ChannelId::kCameraRight, *bundle.arrival.right_alone);
  }
  for (const VehiclePose& pose : bundle.poses) {
    Saw(ChannelId::kVehiclePose, pose.time);
  }
  for (const ImuSample& sample : bundle.imu) {
    Saw(ChannelId::kImu, sample.time);
  }
  for (const GpsFix& fix : bundle.gps) {
    Saw(ChannelId::kGps, fix.time);
    gps_sigma_m_ = fix.sigma_horizontal_m;
  }
  for (const LaserRange& range : bundle.laser) {
    Saw(ChannelId::kLaserRange, range.time);
  }
  if (bundle.status) {
    Saw(ChannelId::kVehicleStatus, bundle.status->time);
  }
}

void ChannelMonitor::AddEstimate(Timestamp last_measured, EstimateSource source) {
  const bool vision = source == EstimateSource::kVision;
  Watch& watch = Of(ChannelId::kPositionEstimate);
  watch.expected_hz = Of(vision ? ChannelId::kCameraLeft : ChannelId::kGps).expected_hz;
  Saw(ChannelId::kPositionEstimate, last_measured);
  watch.lost = 0;  // it is made here: a measurement that it refused is none that was lost
}

std::vector<ChannelHealth> ChannelMonitor::Health(Timestamp now) const {
  std::vector<ChannelHealth> all;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const Watch& watch = watches_[i];
    const auto id = static_cast<ChannelId>(i);
    const bool camera = id == ChannelId::kCameraLeft || id == ChannelId::kCameraRight;
    if (!has_vehicle_ && !camera && watch.count == 0) {
      continue;  // nobody is there to send it
    }
    ChannelHealth health;
    health.id = id;
    health.expected_hz = watch.expected_hz;
    health.count = watch.count;
    health.lost = watch.lost;
    health.lost_share = watch.LostShare();
    const std::optional<Timestamp> last =
        watch.count > 0 ? std::optional(watch.last) : watch.heard_before;
    health.age_s = last ? SecondsBetween(*last, now) : NAN;
    health.rate_hz = RateAt(health.age_s, watch.Rate_hz(), watch.expected_hz);
    if (last) {
      // The bundle itself adds up to one camera period to the age of what it carries.
      health.state = StateAt(std::max(0.0, health.age_s), watch.expected_hz);
    }
    if (id == ChannelId::kGps && gps_sigma_m_ > 0) {
      char note[32];
      std::snprintf(note, sizeof note, "± %.2f m", 3 * gps_sigma_m_);
      health.note = note;
    }
    all.push_back(std::move(health));
  }
  return all;
}

}  // namespace palace
