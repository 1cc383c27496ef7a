// Guards and alarms by name: an enum inside, a stable string on the wire, in logs and in scripts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace palace {

/// What must hold at the instant of approval: G1 to G15, in this order.
enum class GuardId : std::uint8_t {
  kLink,
  kAttitude,
  kCameras,
  kMap,
  kPosition,
  kShown,
  kUnchanged,
  kSite,
  kVehicle,
  kAuthority,
  kWarnings,
  kRecorder,
  kSource,
  kInTime,
  kWind,
};
inline constexpr std::size_t kGuardCount = 15;
/// "G1".
const char* GuardName(GuardId id);

/// In the order in which alarms of one level and one instant are listed.
enum class AlarmId : std::uint8_t {
  kCameraLeft,
  kCameraRight,
  kPose,
  kNoPose,
  kLink,
  kClock,
  kReboot,
  kGpsError,
  kCameraFrozen,
  kCamerasSwapped,
  kRowError,
  kExposure,
  kRangeScale,
  kHeightMismatch,
  kRecorder,
  kRecordThinned,
  kEngineStopped,
  kLogDamaged,
  kNoSite,
  kWaveOff,
  kHold,
  kSiteDegraded,
  kVisionLost,
  kCoherenceLow,
  kApprovalUnanswered,
  kApprovalRefused,
  kForeignDescent,
  kPicturesReplaced,
  kUndecodable,
  kRecordsDropped,
  kMessagesUnsent,
  kOffPath,
  kOffCentre,
  kDescentRate,
  kVisionResidual,
  kWind,
  kDatagramsRefused,
  kRefusedOften,
  kBusOverload,
  kBusOverrun,
  kOtherVersion,
  kSecondSender,
  kStalled,
  kStampsRefused,
  kAttitudeInvalid,
  kMessageLoss,
  kCameraBlank,
  kPairing,
  kOldGround,
  kForeignCommand,
  kViewOnly,
  kImageTime,
  kGravity,
  kGpsJump,
  kGpsLost,
  kLaserLost,
  kLaserStuck,
  kLaserWrong,
  kEnergyLow,
  kTailwind,
  kTrackersApart,
  kNotOnSite,
  kUnusualLimits,
};
inline constexpr std::size_t kAlarmCount = 63;
/// "gps_error".
const char* AlarmName(AlarmId id);
/// Empty for a name that no alarm has.
std::optional<AlarmId> AlarmFromName(std::string_view name);

}  // namespace palace
