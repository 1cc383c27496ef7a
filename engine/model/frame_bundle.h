// FrameBundle: one door into the engine. A stereo pair and all that arrived since the one before.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/model/command.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"
#include "engine/model/vehicle_state.h"

namespace palace {

/// One grey picture and when it was exposed.
struct TimedPicture {
  Timestamp time;
  ImageU8 grey;
};

/// Grey pictures of both cameras, exposed together.
struct StereoFrame {
  Timestamp time;  ///< of exposure
  ImageU8 left;
  ImageU8 right;
};

/// Immutable once published. Samples are in order of time and lie after the previous bundle's time.
struct FrameBundle {
  std::uint64_t sequence = 0;
  Timestamp time;  ///< active clock when complete, for ages; zero while a live source heard nothing
  std::shared_ptr<const StereoRig> rig;
  std::shared_ptr<const StereoFrame> stereo;    ///< null: a bundle without pictures
  std::optional<VehiclePose> pose_at_exposure;  ///< autopilot pose at stereo->time
  std::vector<VehiclePose> poses;
  std::vector<ImuSample> imu;
  std::vector<GpsFix> gps;
  std::vector<LaserRange> laser;
  std::optional<VehicleStatus> status;
  std::vector<CommandAck> acks;
  std::vector<Truth> truth;
  /// Replay only: what was posted before this bundle when it was recorded.
  std::vector<EngineCommand> recorded_commands;
  /// First bundle after a jump in time (a seek, a step back): filters and maps start afresh.
  bool discontinuity = false;
};

}  // namespace palace
