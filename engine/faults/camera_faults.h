// CameraFaults: what a failed camera delivers in place of its picture. Pure: the same seed, frames
// and faults give the same bits.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "engine/core/random.h"
#include "engine/faults/fault.h"
#include "engine/model/frame_bundle.h"

namespace palace {

class CameraFaults {
 public:
  explicit CameraFaults(std::uint64_t seed) : seed_(seed), random_(seed, "faults of pictures") {}

  /// Once a frame, in order of time, also while no fault acts: what is late or frozen comes from
  /// frames before. Never null; the frame itself when nothing strikes it.
  std::shared_ptr<const StereoFrame> Apply(std::shared_ptr<const StereoFrame> frame,
                                           const std::vector<Fault>& faults, double now_s);

 private:
  void Strike(const Fault& fault, ChannelId camera, ImageU8 StereoFrame::*side, StereoFrame& frame);
  /// The picture of the first moment of a freeze, kept as long as it lasts.
  const ImageU8& Frozen(ChannelId camera, const ImageU8& now);
  void AddNoise(int most_grey, ImageU8& picture);
  /// Now and then the picture shown last instead of this one; both as the camera took them.
  void Repeat(double percent, ChannelId camera, ImageU8 StereoFrame::*side, ImageU8& picture);
  void AddDirt(double percent, ChannelId camera, ImageU8& picture);

  const std::uint64_t seed_;
  RandomStream random_;
  std::deque<std::shared_ptr<const StereoFrame>> recent_;
  ImageU8 frozen_left_, frozen_right_;
  std::shared_ptr<const StereoFrame> shown_left_, shown_right_;
  struct Dirt {
    std::size_t count = 0;                ///< of pixels that it covers
    std::vector<std::uint8_t> covered{};  ///< one a pixel
  };
  Dirt dirt_left_, dirt_right_;
};

}  // namespace palace
