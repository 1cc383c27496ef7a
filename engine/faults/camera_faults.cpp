#include "engine/faults/camera_faults.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palace {
namespace {

constexpr double kMemory_s = 2;
constexpr double kStampSlack_s = 1e-4;
constexpr int kDarkNoise_grey = 2;
constexpr double kThroughDirt = 1.0 / 3;
constexpr double kLeastBlotch = 0.02, kMostBlotch = 0.08;  // radius, of the picture's width

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

void AddGlare(double grey, ImageU8& picture) {
  const int last = std::max(1, picture.width() - 1);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      picture.at(x, y) = Grey(picture.at(x, y) + grey * x / last);
    }
  }
}

/// Round blotches anywhere, until exactly `count` pixels are covered.
std::vector<std::uint8_t> Blotches(RandomStream& random, std::size_t count, int width, int height) {
  std::vector<std::uint8_t> covered(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
  std::size_t done = 0;
  while (done < std::min(count, covered.size())) {
    const double cx = random.Uniform(0, width), cy = random.Uniform(0, height);
    const double r = width * random.Uniform(kLeastBlotch, kMostBlotch) + 1;
    for (int y = std::max(0, static_cast<int>(cy - r)); y < std::min<double>(height, cy + r); ++y) {
      for (int x = std::max(0, static_cast<int>(cx - r)); x < std::min<double>(width, cx + r);
           ++x) {
        std::uint8_t& pixel =
            covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
        if (pixel == 0 && done < count && std::hypot(x - cx, y - cy) <= r) {
          pixel = 1;
          ++done;
        }
      }
    }
  }
  return covered;
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
  const auto repeats = [&](ChannelId camera) {
    return std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
      return fault.kind == FaultKind::kCameraRepeated && fault.ActsAt(now_s) &&
             fault.Strikes(camera);
    });
  };
  shown_left_ = repeats(ChannelId::kCameraLeft) ? std::move(shown_left_) : frame;
  shown_right_ = repeats(ChannelId::kCameraRight) ? std::move(shown_right_) : frame;
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
    case FaultKind::kCameraRepeated:
      Repeat(value, camera, side, picture);
      break;
    case FaultKind::kCameraDirt:
      AddDirt(value, camera, picture);
      break;
    case FaultKind::kCameraGlare:
      AddGlare(value, picture);
      break;
    default:
      break;
  }
}

void CameraFaults::Repeat(double percent, ChannelId camera, ImageU8 StereoFrame::*side,
                          ImageU8& picture) {
  auto& shown = camera == ChannelId::kCameraLeft ? shown_left_ : shown_right_;
  if (shown && 100 * random_.Uniform() < percent) {
    picture = (*shown).*side;
  } else {
    shown = recent_.back();
  }
}

void CameraFaults::AddDirt(double percent, ChannelId camera, ImageU8& picture) {
  const bool left = camera == ChannelId::kCameraLeft;
  Dirt& dirt = left ? dirt_left_ : dirt_right_;
  const auto count = static_cast<std::size_t>(
      std::llround(percent / 100 * static_cast<double>(picture.pixels().size())));
  if (dirt.count != count || dirt.covered.size() != picture.pixels().size()) {
    RandomStream where(seed_, left ? "dirt on the left lens" : "dirt on the right lens");
    dirt = {count, Blotches(where, count, picture.width(), picture.height())};
  }
  for (std::size_t i = 0; i < dirt.covered.size(); ++i) {
    std::uint8_t& grey = picture.pixels()[i];
    grey = dirt.covered[i] != 0 ? Grey(kThroughDirt * grey) : grey;
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
