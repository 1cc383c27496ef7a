// Filmed stereo pairs as a source of frames: two video files, or one with both pictures in it.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/capture/frame_pairing.h"
#include "engine/capture/opencv_camera.h"
#include "engine/capture/playback_turns.h"
#include "engine/capture/rig_cameras.h"
#include "engine/runtime/source.h"

namespace palace {

struct VideoSourceOptions {
  OpenCamera open = OpenWithOpenCv;
  bool wait_at_end = false;  ///< hold at the end until somebody seeks, instead of kEnd
};

/// Lockstep: every pair is given, in order, and the same files give the same bundles. A picture's
/// time is its container's, counted from the start of its file, so both films begin together; one
/// that does not advance, or by more than a minute, stands one period after the one before.
/// Pictures of two files pair by nearest time (FramePairing). The end of either file is the end;
/// with `loop` in RIG.toml the films begin again, time running on. Paced to `speed` times the
/// container's rate, 0 as fast as possible. A seek or a lap marks its bundle as a discontinuity.
class VideoSource final : public Source {
 public:
  /// Opens the files and reads the first pair. Errors name file, sizes and remedy.
  static Result<std::unique_ptr<VideoSource>> Open(RigCameras cameras,
                                                   VideoSourceOptions options = {});

  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override;
  void Control(const PlaybackControl& control) override { turns_->Control(control); }

 private:
  struct Film {
    CameraRequest request;
    CameraDevice device;
    double newest_s = NAN;  ///< time of the newest picture; NaN before one, and after a seek
  };
  VideoSource(RigCameras cameras, VideoSourceOptions options);
  ::palace::Status OpenFilms();
  void ForgetWaiting();
  Result<TimedPicture> ReadFrom(std::size_t film);
  Result<PicturePair> ReadPair();
  Result<PicturePair> PairAt(std::int64_t index);
  /// The next pair read is that at or after this time.
  ::palace::Status GoTo(double time_s);
  void NoteEnd();
  Error NoPairs() const;

  const RigCameras cameras_;
  const VideoSourceOptions options_;
  double rate_hz_ = 0;
  std::shared_ptr<const StereoRig> rig_;
  std::vector<Film> films_;
  std::optional<FramePairing> pairing_;
  std::optional<PlaybackTurns> turns_;
  std::optional<PicturePair> pending_;  ///< read, but not yet given
  std::int64_t position_ = 0;           ///< index of the pair that is read next
  std::optional<std::int64_t> end_;     ///< index after the last pair, once it was met
  double lap_start_s_ = 0;              ///< when this lap began
  double lap_s_ = 0;                    ///< what it lasted so far
  std::uint64_t sequence_ = 0;
  bool jump_pending_ = false;

  mutable std::mutex mutex_;  ///< guards what Status reads
  std::vector<CameraCounters> counters_;
};

}  // namespace palace
