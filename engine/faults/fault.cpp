#include "engine/faults/fault.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kDay_s = 86400;

bool CanStrike(FaultKind kind, ChannelId id) {
  const std::vector<ChannelId> channels = ChannelsOf(kind);
  return std::find(channels.begin(), channels.end(), id) != channels.end();
}

}  // namespace

std::vector<ChannelId> ChannelsOf(FaultKind kind) {
  using C = ChannelId;
  if (kind >= FaultKind::kMissing) {  // of the link: any of the vehicle's
    return {C::kCameraLeft, C::kCameraRight, C::kVehiclePose,  C::kImu,
            C::kGps,        C::kLaserRange,  C::kVehicleStatus};
  }
  return kind < FaultKind::kCamerasSwapped ? std::vector{C::kCameraLeft, C::kCameraRight}
                                           : std::vector<C>{};
}

const char* FaultVerbName(FaultVerb verb) {
  constexpr const char* kNames[] = {"off",  "stuck",   "garbage",     "wrong",
                                    "slow", "delayed", "intermittent"};
  return kNames[static_cast<std::size_t>(verb)];
}

const std::vector<FaultKindRow>& FaultKindTable() {
  using K = FaultKind;
  using V = FaultVerb;
  static const std::vector<FaultKindRow> kTable = {
      {K::kCameraBlack, V::kOff, "camera_black", "", NAN, 0, 0, "Every pixel is 0"},
      {K::kCameraFrozen, V::kStuck, "camera_frozen", "", NAN, 0, 0,
       "The picture of the first moment, again and again"},
      {K::kCameraFrozenPixel, V::kStuck, "camera_frozen_pixel", "", NAN, 0, 0,
       "Frozen, but for one pixel that changes each time"},
      {K::kCameraFrozenNoise, V::kStuck, "camera_frozen_noise", "grey levels", 1, 0, 16,
       "Frozen, with fresh noise up to this much on every pixel"},
      {K::kCameraDark, V::kWrong, "camera_dark", "times as bright", 0.04, 0, 1,
       "Nearly no light, the camera's noise stays"},
      {K::kCameraOverexposed, V::kWrong, "camera_overexposed", "times as bright", 6, 1, 100,
       "Too much light: most pixels saturate"},
      {K::kCameraLate, V::kDelayed, "camera_late", "s", 0.3, 0, 2,
       "The content is this old, in whole pictures; stamps are of now"},
      {K::kCameraRepeated, V::kStuck, "camera_repeated", "%", 30, 0, 100,
       "This share of pictures is the one before once more, each camera by itself"},
      {K::kCameraDirt, V::kWrong, "camera_dirt", "%", 10, 0, 100,
       "Blotches on the lens: this share of the picture gets a third of its light"},
      {K::kCameraGlare, V::kWrong, "camera_glare", "grey levels", 120, 0, 255,
       "Veiling glare: light added, from none at the left edge to this much at the right"},
      {K::kCamerasSwapped, V::kWrong, "cameras_swapped", "", NAN, 0, 0,
       "Left and right are exchanged"},
      {K::kAttitudeNan, V::kGarbage, "attitude_nan", "", NAN, 0, 0,
       "The rotation of every pose is not a number"},
      {K::kAttitudeLate, V::kDelayed, "attitude_late", "s", 0.3, 0, 2,
       "Poses come this much later, with the right stamps"},
      {K::kAttitudeShifted, V::kWrong, "attitude_shifted", "s", 0.1, -1, 1,
       "Stamps of poses are off by this much against pictures and other sensors"},
      {K::kAttitudeBias, V::kWrong, "attitude_bias", "°", 3, -30, 30,
       "Every pose is rolled right by this much; places and rates are right"},
      {K::kImuGyroBias, V::kWrong, "imu_gyro_bias", "°/s", 2, -90, 90,
       "The inertial unit's rate of roll is off by this much; poses are right"},
      {K::kImuAccelBias, V::kWrong, "imu_accel_bias", "m/s2", 0.5, -20, 20,
       "The inertial unit's forward acceleration is off by this much; poses are right"},
      {K::kLaserStuck, V::kStuck, "laser_stuck", "", NAN, 0, 0, "The last range for ever"},
      {K::kLaserScaled, V::kWrong, "laser_scaled", "times the range", 0.5, 0.01, 100,
       "Every range times this"},
      {K::kLaserSpikes, V::kIntermittent, "laser_spikes", "m", 20, -60, 60,
       "One range in twenty is off by this much"},
      {K::kLaserNoReturn, V::kOff, "laser_no_return", "", NAN, 0, 0,
       "The laser answers, but no echo comes back to it"},
      {K::kGpsJump, V::kWrong, "gps_jump", "m", 8, -1e5, 1e5,
       "Fixes lie this far north of the truth; their velocities are right"},
      {K::kGpsDrift, V::kWrong, "gps_drift", "m/s", 0.5, -100, 100,
       "Fixes move north at this rate; their velocities are right"},
      {K::kGpsCanyon, V::kIntermittent, "gps_canyon", "m", 3, 0, 100,
       "Multipath: each axis wanders with this sigma and 5 s correlation, half the fixes are lost"},
      {K::kClockStep, V::kWrong, "clock_step", "s", 5, -100 * kDay_s, 100 * kDay_s,
       "The vehicle's clock steps by this much"},
      {K::kClockDrift, V::kWrong, "clock_drift", "s/s", 0.01, -0.5, 0.5,
       "The vehicle's clock gains this much each second"},
      {K::kNewBoot, V::kWrong, "new_boot", "", NAN, 0, 0,
       "Another boot id, as if the vehicle had restarted; its clock goes on"},
      {K::kRestart, V::kWrong, "restart", "", NAN, 0, 0,
       "Another boot id, a clock that starts again at the first stamp, in hover, no approval"},
      {K::kMissing, V::kOff, "missing", "", NAN, 0, 0, "No message comes"},
      {K::kLost, V::kSlow, "lost", "%", 30, 0, 100, "This share of messages is lost"},
      {K::kCorrupted, V::kGarbage, "corrupted", "%", 5, 0, 100,
       "In this share of messages one bit is flipped"},
      {K::kReordered, V::kDelayed, "reordered", "%", 20, 0, 100,
       "This share of messages comes after up to eight of those that follow it"},
      {K::kDuplicated, V::kIntermittent, "duplicated", "%", 20, 0, 100,
       "This share of messages comes twice"},
  };
  return kTable;
}

const FaultKindRow& RowOf(FaultKind kind) {
  const auto i = static_cast<std::size_t>(kind);
  PALACE_CHECK(i < FaultKindTable().size(), i);
  return FaultKindTable()[i];
}

double Fault::ValueOrDefault() const {
  return std::isnan(value) ? RowOf(kind).default_value : value;
}

Status CheckFault(const Fault& fault) {
  const FaultKindRow& row = RowOf(fault.kind);
  const std::string name = std::string("fault ") + row.name;
  if (!(fault.from_s >= 0) || !(fault.to_s > fault.from_s)) {
    return InvalidError(name + WithNumbers(": acts from %.3f s to %.3f s; it must begin at 0 s or "
                                           "later and end after its beginning",
                                           fault.from_s, fault.to_s));
  }
  if (std::isnan(row.default_value) && !std::isnan(fault.value)) {
    return InvalidError(name + ": takes no value");
  }
  const double value = fault.ValueOrDefault();
  if (!std::isnan(row.default_value) && !(value >= row.least && value <= row.most)) {
    return InvalidError(name + WithNumbers(": value %g, allowed %g", value, row.least) +
                        WithNumbers(" to %g ", row.most) + row.unit);
  }
  if (fault.channel && !CanStrike(fault.kind, *fault.channel)) {
    return InvalidError(name + ": cannot strike " + ChannelName(*fault.channel));
  }
  return Ok();
}

}  // namespace palace
