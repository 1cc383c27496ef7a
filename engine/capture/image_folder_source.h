// A folder of stereo pairs as a source of frames: RIG.toml names the files and the pose, or the
// folder is in EuRoC's layout and tells all itself.
#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/camera/files/rig_file.h"
#include "engine/capture/image_sequence.h"
#include "engine/capture/playback_turns.h"
#include "engine/runtime/source.h"

namespace palace {

/// Pair k is exposed at 1'000'000 s + k / rate_hz in data time, and every bundle carries the pose
/// of [pose] (none without that table); with [images] poses, times and poses are those of that file
/// and rate_hz their mean (image_sequence.h). Of an EuRoC folder likewise, with the poses of its
/// ground truth (euroc_folder.h); what is left out of it is logged. No vehicle status and no laser:
/// there is no vehicle. Lockstep; pairs follow each other as they were taken, `speed` times as
/// fast, 0 as fast as possible. With `loop` the last pair is repeated for ever at rate_hz, with new
/// sequence numbers and advancing time.
class ImageFolderSource final : public Source {
 public:
  /// `pictures`: a RIG.toml, or an EuRoC folder. Refuses rigs without [images], patterns without
  /// files, and what SequenceOf or LoadEurocFolder refuse. The first pair is read, so that a wrong
  /// size is found at once.
  static Result<std::unique_ptr<ImageFolderSource>> Open(const std::filesystem::path& pictures,
                                                         bool loop);

  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override;
  void Control(const PlaybackControl& control) override;

 private:
  ImageFolderSource(RigFile file, std::vector<ImagePair> pairs, std::string name, bool loop);
  Result<std::shared_ptr<const StereoFrame>> LoadPair(std::int64_t index);
  /// The last one for all that follow it.
  const ImagePair& PairAt(std::int64_t index) const;

  const RigFile file_;
  const std::shared_ptr<const StereoRig> rig_;
  const std::vector<ImagePair> pairs_;
  const std::string name_;
  std::shared_ptr<const StereoFrame> cached_;  ///< last pair read; used by Next only
  const ImagePair* cached_pair_ = nullptr;
  std::uint64_t sequence_ = 0;
  const PictureTimes times_;
  PlaybackTurns turns_;
};

}  // namespace palace
