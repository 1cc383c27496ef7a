// FrameBundle: one door into the engine. A stereo pair and all that arrived since the one before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/vehicle_clock.h"
#include "engine/model/channel.h"
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

/// What the station itself noted while the bundle came together. It is recorded with the bundle, so
/// that a replay decides alike. Sources whose clock is the data's own leave it as it is here.
struct ArrivalNotes {
  std::optional<ClockReading> clock;  ///< of a live source
  /// Stamp of the newest picture that came without its partner: which camera is lost.
  std::optional<Timestamp> left_alone, right_alone;
  int poses_invalid = 0;  ///< vehicle poses refused: attitude or place no numbers
  /// Messages by ChannelId that came whole and that newer ones overtook here before anybody looked:
  /// none of them was lost on the way.
  std::array<int, kChannelCount> overtaken{};
  friend bool operator==(const ArrivalNotes&, const ArrivalNotes&) = default;
};

/// Immutable once published. Samples are in order of time and lie after the previous bundle's time.
struct FrameBundle {
  std::uint64_t sequence = 0;
  /// The active clock when it was complete, for ages. Of a live source the vehicle's clock as the
  /// station's monotonic one tells it, so that it runs on by itself; zero while nothing was heard.
  Timestamp time;
  std::shared_ptr<const StereoRig> rig;
  std::shared_ptr<const StereoFrame> stereo;    ///< null: a bundle without pictures
  std::optional<VehiclePose> pose_at_exposure;  ///< autopilot pose at stereo->time
  std::vector<VehiclePose> poses;
  std::vector<ImuSample> imu;
  std::vector<GpsFix> gps;
  std::vector<LaserRange> laser;
  std::optional<VehicleStatus> status;
  std::vector<CommandAck> acks;
  std::optional<AuthorityReport> authority;  ///< who commands, when the vehicle told
  std::vector<Truth> truth;
  std::vector<RefusedDatagram> refused;  ///< not let in meanwhile: for the record alone
  ArrivalNotes arrival;
  /// Replay only: what was posted before this bundle when it was recorded.
  std::vector<EngineCommand> recorded_commands;
  /// Simulation only: the faults that act, in words, oldest first ("GPS jump 3 m"). On no wire; the
  /// station makes events of what begins and ends.
  std::vector<std::string> injected_faults;
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
