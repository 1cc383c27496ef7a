// Faults between a vehicle and its station: what fails, from when to when, and by how much.
//
// Seven verbs, as autopilots' own injectors have them: off, stuck, garbage, wrong, slow, delayed,
// intermittent. A kind is one verb on one sensor or on the link; the table says what its value
// means and in which unit. Times are seconds of true flight since the first bundle, whatever the
// vehicle's clock says.
// Source: reference/reliability.md 4 (F01-F25); PX4, "System failure injection" (the verbs).
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/channel.h"

namespace palace {

enum class FaultVerb : std::uint8_t {
  kOff,           ///< nothing comes any more
  kStuck,         ///< the last value for ever, with stamps that advance
  kGarbage,       ///< bytes or numbers without sense
  kWrong,         ///< numbers that look right and are not
  kSlow,          ///< less often than it should
  kDelayed,       ///< right, but late
  kIntermittent,  ///< now and then
};
/// "off".
const char* FaultVerbName(FaultVerb verb);

enum class FaultKind : std::uint8_t {
  // Pictures: of the camera in `channel`, of both where none is given.
  kCameraBlack,
  kCameraFrozen,
  kCameraFrozenPixel,
  kCameraFrozenNoise,
  kCameraDark,
  kCameraOverexposed,
  kCameraLate,
  kCameraRepeated,
  kCameraDirt,
  kCameraGlare,
  kCamerasSwapped,
  // The autopilot's own solution, and what it is made of.
  kAttitudeNan,
  kAttitudeLate,
  kAttitudeShifted,
  kAttitudeBias,
  kImuGyroBias,
  kImuAccelBias,
  kLaserStuck,
  kLaserScaled,
  kLaserSpikes,
  kLaserNoReturn,
  kGpsJump,
  kGpsDrift,
  kGpsCanyon,
  // The vehicle itself.
  kClockStep,
  kClockDrift,
  kNewBoot,
  kRestart,
  // Messages: of one channel, of all where none is given.
  kMissing,
  kLost,
  kCorrupted,
  kReordered,
  kDuplicated,
};
inline constexpr std::size_t kFaultKindCount = 33;

struct FaultKindRow {
  FaultKind kind;
  FaultVerb verb;
  const char* name;      ///< "camera_frozen", as tables and files write it
  const char* unit;      ///< of the value; empty: it has none
  double default_value;  ///< NaN where it has none
  double least, most;    ///< values that mean something
  const char* what;      ///< a sentence
};
/// Channels that a kind strikes where none is given and that one may be chosen of; empty: the kind
/// says itself what it strikes.
std::vector<ChannelId> ChannelsOf(FaultKind kind);
/// All of them, in the order of FaultKind.
const std::vector<FaultKindRow>& FaultKindTable();
const FaultKindRow& RowOf(FaultKind kind);

struct Fault {
  FaultKind kind = FaultKind::kMissing;
  std::optional<ChannelId> channel{};  ///< none: all that the kind can strike
  double value = NAN;                  ///< NaN: the default of the table
  double from_s = 0;
  double to_s = std::numeric_limits<double>::infinity();

  bool ActsAt(double now_s) const { return now_s >= from_s && now_s < to_s; }
  double ValueOrDefault() const;
  bool Strikes(ChannelId id) const { return !channel || *channel == id; }
  /// To the bit; values and times that were left out are alike.
  friend bool operator==(const Fault& a, const Fault& b) {
    const bool same_value = a.value == b.value || (std::isnan(a.value) && std::isnan(b.value));
    return a.kind == b.kind && a.channel == b.channel && same_value && a.from_s == b.from_s &&
           a.to_s == b.to_s;
  }
};

/// Refuses a value outside of the table, a channel that the kind cannot strike and an interval that
/// is none; the message names what and the limit.
Status CheckFault(const Fault& fault);

}  // namespace palace
