#include "engine/mission/watch/input_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palace {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
/// Statuses arrive with some jitter; a larger change of offset is a step of a clock.
constexpr double kClockStep_s = 0.5;

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
  return Worse(left_.Age(now), left_channel_.Age(now));
}
double InputWatch::RightCameraAge(Timestamp now) const {
  return Worse(right_.Age(now), right_channel_.Age(now));
}

InputWatch InputWatch::AfterJump() const {
  InputWatch next;
  next.boot_before_jump_ = vehicle_ ? std::optional(vehicle_->boot_id) : boot_before_jump_;
  return next;
}

InputWatch InputWatch::AsHeard(const std::vector<ChannelHealth>& channels,
                               const FrameBundle& bundle, Timestamp now) {
  InputWatch watch;
  const auto restore = [&](Arrival& arrival, ChannelId id) {
    const ChannelHealth* channel = FindChannel(channels, id);
    if (channel != nullptr && channel->state != ChannelHealth::State::kNever) {
      arrival.See(AddSeconds(now, -channel->age_s), AddSeconds(now, -channel->age_s));
    }
  };
  restore(watch.left_, ChannelId::kCameraLeft);
  restore(watch.right_, ChannelId::kCameraRight);
  restore(watch.pose_, ChannelId::kVehiclePose);
  if (!bundle.status) {  // the one that came with it is new
    restore(watch.link_, ChannelId::kVehicleStatus);
  }
  // Which pictures paired is not told; both came until one of them was lost.
  if (watch.left_.stamp && watch.right_.stamp) {
    watch.pair_ = watch.left_.seen < watch.right_.seen ? watch.left_ : watch.right_;
  }
  return watch;
}

void InputWatch::SeeCameras(const FrameBundle& bundle, Timestamp now) {
  if (bundle.stereo) {
    const bool left = !bundle.stereo->left.empty(), right = !bundle.stereo->right.empty();
    if (left) {
      left_.See(bundle.stereo->time, now);
    }
    if (right) {
      right_.See(bundle.stereo->time, now);
    }
    if (left && right) {
      pair_.See(bundle.stereo->time, now);
    }
  }
  if (bundle.arrival.left_alone) {
    left_.See(*bundle.arrival.left_alone, now);
  }
  if (bundle.arrival.right_alone) {
    right_.See(*bundle.arrival.right_alone, now);
  }
}

void InputWatch::SeePose(const VehiclePose& pose, Timestamp now) {
  if (!pose_.stamp || pose.time > *pose_.stamp) {
    pose_climb_mps_ = -pose.v_WB.z();
  }
  pose_.See(pose.time, now);
}

void InputWatch::SeePoses(const FrameBundle& bundle, Timestamp now) {
  bool invalid = bundle.arrival.poses_invalid > 0;
  for (const VehiclePose& pose : bundle.poses) {
    if (IsFinite(pose)) {
      SeePose(pose, now);
    } else {
      invalid = true;
    }
  }
  if (bundle.pose_at_exposure && IsFinite(*bundle.pose_at_exposure)) {
    SeePose(*bundle.pose_at_exposure, now);
  }
  if (invalid) {
    if (std::isnan(PosesInvalidFor(now))) {
      poses_invalid_from_ = now;
    }
    pose_invalid_at_ = now;
  }
}

void InputWatch::SeeClock(const std::optional<ClockReading>& clock, Timestamp now) {
  if (!clock) {
    return;
  }
  clock_ = clock;
  if (clock->stepped_s != 0) {
    clock_stepped_ = true;
    clock_step_s_ = clock->stepped_s;
    stepped_at_ = now;
    consistent_samples_ = 0;
  }
  if (clock->stalled_s > 0) {
    stalled_s_ = clock->stalled_s;
    stalled_at_ = now;
  }
}

void InputWatch::Update(const FrameBundle& bundle, const std::vector<ChannelHealth>& channels,
                        Timestamp now) {
  clock_stepped_ = rebooted_ = false;
  SeeClock(bundle.arrival.clock, now);
  SeeCameras(bundle, now);
  SeePoses(bundle, now);
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
  climb_mps_ = pose_climb_mps_;
  rebooted_ = (vehicle_ && vehicle_->boot_id != status.boot_id) ||
              (boot_before_jump_ && *boot_before_jump_ != status.boot_id);
  boot_before_jump_.reset();
  const std::int64_t offset_us = SaturatedDifference(status.time.us, now.us);
  const bool backwards = link_.stamp && status.time < *link_.stamp;
  const double change_s = SecondsBetween({offset_us_}, {offset_us});
  const bool jumps = backwards || std::abs(change_s) > kClockStep_s;
  if (!clock_ && vehicle_ && jumps && !rebooted_) {
    clock_stepped_ = true;
    clock_step_s_ = change_s;
    stepped_at_ = now;
  }
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
