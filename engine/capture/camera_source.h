// Live stereo cameras as a source of frames: two devices or streams, or one side by side.
#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "engine/capture/camera_feed.h"
#include "engine/capture/opencv_camera.h"
#include "engine/capture/rig_cameras.h"
#include "engine/runtime/source.h"

namespace palace {

struct CameraSourceOptions {
  OpenCamera open = OpenWithOpenCv;
  std::function<double()> now_s = MonotonicSeconds;
  Timestamp start = WallTime();  ///< data time of now_s at Open; advances with now_s, never steps
  /// Without a pair for this long, Next delivers a bundle without pictures, so that ages grow.
  double heartbeat_s = 0.2;
  /// A camera that still blocks after this long is left behind when the source ends.
  double stop_within_s = 2;
  ReopenPauses pauses;
};

/// One thread a camera takes its pictures, stamps them as they arrive and hands them to the
/// pairing; Next gives the newest pair (an older one that nobody took is dropped: newest wins). A
/// camera that fails says so in Status, is closed and tried again (CameraFeed). Nothing to control:
/// live time cannot be paused.
///
/// Bundle times are the clock's when the pair was taken; the pair's time is the arrival of its left
/// picture. Arrival lags exposure by the camera's own delay, which nobody tells: for a moving
/// vehicle measure it and shift the poses, do not shift the pictures.
class CameraSource final : public Source {
 public:
  /// Opens every camera and checks its first picture. Errors name the camera and the remedy.
  static Result<std::unique_ptr<CameraSource>> Open(RigCameras cameras,
                                                    CameraSourceOptions options = {});
  /// Returns within stop_within_s, whatever the devices do.
  ~CameraSource() override;

  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return false; }
  SourceStatus Status() const override;
  Losses Lost() const override;
  void Control(const PlaybackControl&) override {}

 private:
  struct Shared;
  CameraSource(std::shared_ptr<Shared> shared, std::optional<VehiclePose> pose,
               CameraSourceOptions options);
  static void Grab(const std::shared_ptr<Shared>& shared, CameraFeed& feed, std::size_t index);

  const std::shared_ptr<Shared> shared_;  ///< outlives this object while a camera blocks
  const std::shared_ptr<const StereoRig> rig_;
  const std::optional<VehiclePose> pose_;
  const CameraSourceOptions options_;
  std::vector<std::thread> threads_;
  std::uint64_t sequence_ = 0;
  std::uint64_t overtaken_told_ = 0;  ///< pairs, with a bundle
};

}  // namespace palace
