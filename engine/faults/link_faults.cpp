#include "engine/faults/link_faults.h"

#include <utility>

namespace palace {
namespace {

constexpr int kMostOvertaking = 8;
// pose_t: hash, utime, pos[3], vel[3], then orientation[4], each number of 8 bytes, big-endian.
constexpr std::size_t kOrientation = 8 * 8;
constexpr std::size_t kOrientationEnd = kOrientation + 4 * 8;

void MakeNan(WireMessage& pose) {
  for (std::size_t at = kOrientation; at < kOrientationEnd && at + 1 < pose.payload.size();
       at += 8) {
    pose.payload[at] = 0x7f;
    pose.payload[at + 1] = 0xf8;
  }
}

}  // namespace

bool LinkFaults::Strikes(const Fault& fault, const WireMessage& message) const {
  if (message.channel == channels_.truth) {
    return false;
  }
  if (!fault.channel) {
    return true;
  }
  const std::pair<ChannelId, const std::string*> names[] = {
      {ChannelId::kCameraLeft, &channels_.camera_left},
      {ChannelId::kCameraRight, &channels_.camera_right},
      {ChannelId::kVehiclePose, &channels_.vehicle_pose},
      {ChannelId::kImu, &channels_.imu},
      {ChannelId::kGps, &channels_.gps},
      {ChannelId::kLaserRange, &channels_.laser_range},
      {ChannelId::kVehicleStatus, &channels_.vehicle_status}};
  for (const auto& [id, name] : names) {
    if (id == *fault.channel) {
      return message.channel == *name;
    }
  }
  return false;
}

void LinkFaults::Send(WireMessage message, std::vector<WireMessage>& arrived) {
  arrived.push_back(std::move(message));
  for (Delayed& waiting : delayed_) {
    --waiting.after;
  }
  while (!delayed_.empty() && delayed_.front().after <= 0) {
    arrived.push_back(std::move(delayed_.front().message));
    delayed_.pop_front();
  }
}

std::vector<WireMessage> LinkFaults::Apply(std::vector<WireMessage> messages,
                                           const std::vector<Fault>& faults, double now_s) {
  std::vector<WireMessage> arrived;
  for (WireMessage& message : messages) {
    bool lost = false, twice = false, late = false;
    for (const Fault& fault : faults) {
      if (fault.kind == FaultKind::kAttitudeNan && fault.ActsAt(now_s) &&
          message.channel == channels_.vehicle_pose) {
        MakeNan(message);
      }
      if (fault.kind < FaultKind::kMissing || !fault.ActsAt(now_s) || !Strikes(fault, message)) {
        continue;
      }
      const bool hit =
          fault.kind == FaultKind::kMissing || 100 * random_.Uniform() < fault.ValueOrDefault();
      if (!hit) {
        continue;
      }
      lost = lost || fault.kind == FaultKind::kMissing || fault.kind == FaultKind::kLost;
      twice = twice || fault.kind == FaultKind::kDuplicated;
      late = late || fault.kind == FaultKind::kReordered;
      if (fault.kind == FaultKind::kCorrupted && !message.payload.empty()) {
        const int bit = random_.Index(8 * static_cast<int>(message.payload.size()));
        message.payload[static_cast<std::size_t>(bit / 8)] ^=
            static_cast<std::uint8_t>(1U << (bit % 8));
      }
    }
    if (lost) {
      continue;
    }
    if (late) {
      delayed_.push_back({1 + random_.Index(kMostOvertaking), std::move(message)});
      continue;
    }
    if (twice) {
      Send(message, arrived);
    }
    Send(std::move(message), arrived);
  }
  return arrived;
}

}  // namespace palace
