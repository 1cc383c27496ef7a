// FrameBundle: one door into the engine. A stereo pair and all that arrived since the one before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/model/command.h"
#include "engine/model/image.h"
#include "engine/model/refused_datagram.h"
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
  std::vector<RefusedDatagram> refused;  ///< not let in meanwhile: for the record alone
  /// Replay only: what was posted before this bundle when it was recorded.
  std::vector<EngineCommand> recorded_commands;
  /// First bundle after a jump in time (a seek, a step back): filters and maps start afresh.
  bool discontinuity = false;
};

/// The same without its pictures: for a reader that has no room for them.
FrameBundle WithoutPictures(const FrameBundle& bundle);

/// More samples of one kind than this do not wait in one bundle: 200 s of an IMU.
inline constexpr std::size_t kMostSamplesInBundle = 20000;

struct JoinedBundle {
  std::shared_ptr<const FrameBundle> bundle;
  bool pair_replaced = false;       ///< the older pictures were left out
  std::size_t samples_dropped = 0;  ///< the oldest, beyond kMostSamplesInBundle
};

/// Two bundles that reach their reader as one: the newer, with what the older brought before its
/// own. Pictures, and the pose at their exposure, are the newer's if it has any; status and rig the
/// newest known. After a discontinuity of the newer only acknowledgements and commands of the older
/// count: its measurements are of a time that filters and maps forget.
JoinedBundle Join(const FrameBundle& older, const FrameBundle& newer);

}  // namespace palace
