#include "engine/mission/watch/input_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace palace {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
/// Statuses arrive with some jitter; a larger change of offset is a step of a clock.
constexpr std::int64_t kClockStep_us = 500'000;

/// The older of two ages; NaN when either is unknown.
double Worse(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? kNever : std::max(a, b);
}

bool IsFinite(const VehiclePose& pose) {
  return pose.X_WB.R.allFinite() && pose.X_WB.p.allFinite() && pose.v_WB.allFinite();
}

}  // namespace

void InputWatch::Arrival::See(Timestamp message_stamp, Timestamp now) {
  if (!stamp || message_stamp > *stamp) {
    stamp = message_stamp;
    seen = now;
  }
}

double InputWatch::Arrival::Age(Timestamp now) const {
  return stamp && now >= seen ? SecondsBetween(seen, now) : kNever;
}

double InputWatch::PoseAge(Timestamp now) const {
  return Worse(pose_.Age(now), pose_channel_.Age(now));
}
double InputWatch::LeftCameraAge(Timestamp now) const {
  return Worse(stereo_.Age(now), left_channel_.Age(now));
}
double InputWatch::RightCameraAge(Timestamp now) const {
  return Worse(stereo_.Age(now), right_channel_.Age(now));
}

void InputWatch::Update(const FrameBundle& bundle, const std::vector<ChannelHealth>& channels,
                        Timestamp now) {
  clock_stepped_ = rebooted_ = false;
  if (bundle.stereo && !bundle.stereo->left.empty() && !bundle.stereo->right.empty()) {
    stereo_.See(bundle.stereo->time, now);
  }
  for (const VehiclePose& pose : bundle.poses) {
    if (IsFinite(pose)) {
      pose_.See(pose.time, now);
    }
  }
  if (bundle.pose_at_exposure && IsFinite(*bundle.pose_at_exposure)) {
    pose_.See(bundle.pose_at_exposure->time, now);
  }
  if (!bundle.gps.empty()) {
    gps_ = bundle.gps.back();
  }
  const auto age_of = [&](ChannelId id) -> ChannelAge {
    const ChannelHealth* channel = FindChannel(channels, id);
    const bool heard = channel != nullptr && channel->state != ChannelHealth::State::kNever;
    return {heard ? channel->age_s : kNever, now};
  };
  left_channel_ = age_of(ChannelId::kCameraLeft);
  right_channel_ = age_of(ChannelId::kCameraRight);
  pose_channel_ = age_of(ChannelId::kVehiclePose);
  if (bundle.status) {
    WatchVehicle(*bundle.status, now);
  }
}

void InputWatch::WatchVehicle(const VehicleStatus& status, Timestamp now) {
  const bool is_new = !link_.stamp || status.time != *link_.stamp;
  if (!is_new) {
    return;  // A duplicate changes nothing (I8).
  }
  rebooted_ = vehicle_ && vehicle_->boot_id != status.boot_id;
  const std::int64_t offset_us = status.time.us - now.us;
  const bool backwards = link_.stamp && status.time < *link_.stamp;
  clock_stepped_ =
      vehicle_ && (backwards || std::llabs(offset_us - offset_us_) > kClockStep_us) && !rebooted_;
  consistent_samples_ = clock_stepped_ || rebooted_ ? 1 : consistent_samples_ + 1;
  consistent_samples_ = std::min(consistent_samples_, kConsistentSamples);
  if (backwards) {
    link_.stamp.reset();  // the new time line counts from here
  }
  link_.See(status.time, now);
  offset_us_ = offset_us;
  vehicle_ = status;
}

}  // namespace palace
