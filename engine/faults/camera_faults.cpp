#include "engine/faults/camera_faults.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palace {
namespace {

constexpr double kMemory_s = 2;
constexpr double kStampSlack_s = 1e-4;
constexpr int kDarkNoise_grey = 2;

bool IsFreeze(FaultKind kind) {
  return kind == FaultKind::kCameraFrozen || kind == FaultKind::kCameraFrozenPixel ||
         kind == FaultKind::kCameraFrozenNoise;
}

std::uint8_t Grey(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

void Scale(double factor, ImageU8& picture) {
  for (std::uint8_t& grey : picture.pixels()) {
    grey = Grey(factor * grey);
  }
}

}  // namespace

std::shared_ptr<const StereoFrame> CameraFaults::Apply(std::shared_ptr<const StereoFrame> frame,
                                                       const std::vector<Fault>& faults,
                                                       double now_s) {
  recent_.push_back(frame);
  while (SecondsBetween(recent_.front()->time, frame->time) > kMemory_s + kStampSlack_s) {
    recent_.pop_front();
  }
  const auto freezes = [&](ChannelId camera) {
    return std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
      return IsFreeze(fault.kind) && fault.ActsAt(now_s) && fault.Strikes(camera);
    });
  };
  frozen_left_ = freezes(ChannelId::kCameraLeft) ? std::move(frozen_left_) : ImageU8{};
  frozen_right_ = freezes(ChannelId::kCameraRight) ? std::move(frozen_right_) : ImageU8{};
  std::shared_ptr<StereoFrame> struck;
  for (const Fault& fault : faults) {
    if (fault.kind > FaultKind::kCamerasSwapped || !fault.ActsAt(now_s)) {
      continue;
    }
    if (!struck) {
      struck = std::make_shared<StereoFrame>(*frame);
    }
    if (fault.kind == FaultKind::kCamerasSwapped) {
      std::swap(struck->left, struck->right);
      continue;
    }
    Strike(fault, ChannelId::kCameraLeft, &StereoFrame::left, *struck);
    Strike(fault, ChannelId::kCameraRight, &StereoFrame::right, *struck);
  }
  return struck ? std::shared_ptr<const StereoFrame>(std::move(struck)) : frame;
}

void CameraFaults::Strike(const Fault& fault, ChannelId camera, ImageU8 StereoFrame::*side,
                          StereoFrame& frame) {
  if (!fault.Strikes(camera) || (frame.*side).empty()) {
    return;
  }
  ImageU8& picture = frame.*side;
  const double value = fault.ValueOrDefault();
  switch (fault.kind) {
    case FaultKind::kCameraBlack:
      std::fill(picture.pixels().begin(), picture.pixels().end(), std::uint8_t{0});
      break;
    case FaultKind::kCameraFrozen:
    case FaultKind::kCameraFrozenPixel:
    case FaultKind::kCameraFrozenNoise:
      picture = Frozen(camera, picture);
      if (fault.kind == FaultKind::kCameraFrozenPixel) {
        picture.at(picture.width() / 2, picture.height() / 2) =
            static_cast<std::uint8_t>(random_.Index(256));
      } else if (fault.kind == FaultKind::kCameraFrozenNoise) {
        AddNoise(static_cast<int>(std::lround(value)), picture);
      }
      break;
    case FaultKind::kCameraDark:
      Scale(value, picture);
      AddNoise(kDarkNoise_grey, picture);
      break;
    case FaultKind::kCameraOverexposed:
      Scale(value, picture);
      break;
    case FaultKind::kCameraLate: {
      const Timestamp wanted = AddSeconds(frame.time, kStampSlack_s - value);
      const StereoFrame* found = recent_.front().get();
      for (const auto& kept : recent_) {
        found = kept->time <= wanted ? kept.get() : found;
      }
      picture = found->*side;
      break;
    }
    default:
      break;
  }
}

const ImageU8& CameraFaults::Frozen(ChannelId camera, const ImageU8& now) {
  ImageU8& kept = camera == ChannelId::kCameraLeft ? frozen_left_ : frozen_right_;
  if (kept.empty()) {
    kept = now;
  }
  return kept;
}

void CameraFaults::AddNoise(int most_grey, ImageU8& picture) {
  for (std::uint8_t& grey : picture.pixels()) {
    grey = Grey(grey + random_.Index(2 * most_grey + 1) - most_grey);
  }
}

}  // namespace palace
