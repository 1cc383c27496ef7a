// Messages of a vehicle, one value each. Numbers that decisions rest on must be finite; a laser
// without return (NaN) and a truth are the exceptions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"
#include "engine/wire/wire_message.h"

namespace palace {

Result<VehiclePose> PoseFromWire(const WireMessage& message);
Result<ImuSample> ImuFromWire(const WireMessage& message);
Result<GpsFix> GpsFromWire(const WireMessage& message);
Result<LaserRange> LaserFromWire(const WireMessage& message);
Result<VehicleStatus> StatusFromWire(const WireMessage& message);
Result<CommandAck> AckFromWire(const WireMessage& message);
/// Public in convert.h as well.
Result<Truth> DecodeTruth(const WireMessage& message);

/// The bytes are a pose message: if PoseFromWire refuses it, a number in it is none.
bool IsPoseMessage(const WireMessage& message);
/// ARRIVAL: what the station noted while the bundle came together.
Result<ArrivalNotes> ArrivalFromWire(const WireMessage& message);

/// GRAY with consistent stride and size, or MJPEG; at most 8192 pixels a side.
Result<TimedPicture> PictureFromWire(const WireMessage& message);

/// CAMERA_RIG: a rig, and where bundle_end is set, what the bundle holds.
struct RigMessage {
  Timestamp time;
  bool bundle_end = false;
  std::uint64_t sequence = 0;
  std::optional<StereoRig> rig;
  bool has_pictures = false;
  bool has_status = false;
  bool discontinuity = false;
  std::array<int, 6> sample_counts{};  ///< pose, imu, gps, laser, acknowledgement, truth
  std::optional<VehiclePose> exposure_pose;
  std::vector<Eigen::Matrix3d> rotations;  ///< of each pose; may be empty
};
Result<RigMessage> RigFromWire(const WireMessage& message);
/// Equal to the bit.
bool SameRig(const StereoRig& a, const StereoRig& b);

}  // namespace palace
