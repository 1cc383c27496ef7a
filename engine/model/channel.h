// The inputs the station watches: one id each, and how each arrives. What the screen calls them
// stands in one table, ChannelName.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace palace {

enum class ChannelId : std::uint8_t {
  kCameraLeft,
  kCameraRight,
  kVehiclePose,
  kImu,
  kGps,
  kLaserRange,
  kVehicleStatus,
  kPositionEstimate,  ///< the station's own, watched like an input
};
inline constexpr std::size_t kChannelCount = 8;

/// As the screen shows it: "Camera left".
const char* ChannelName(ChannelId id);

/// Arrival of one channel, measured against the active clock.
struct ChannelHealth {
  enum class State : std::uint8_t { kNever, kFresh, kLate, kStale };
  ChannelId id = ChannelId::kCameraLeft;
  State state = State::kNever;
  double age_s = NAN;  ///< NaN when never
  double rate_hz = 0;  ///< of messages, by their stamps: channel_age.h
  double expected_hz = 0;
  std::uint64_t count = 0;  ///< that came, overtaken ones too
  std::uint64_t lost = 0;   ///< missing between those that came
  std::string note;         ///< e.g. "± 2.6 m"
  /// Share of the last kLossWindow_s that is missing, by the channel's own beat; NaN: not known.
  double lost_share = NAN;
};

inline constexpr double kLossWindow_s = 5;

/// Of lost_share. More is no channel that works: it is told, and alarmed.
inline constexpr double kMostLostShare = 0.1;
bool LosesMuch(const ChannelHealth& channel);

/// Null when that channel is not listed; then nothing of it is fresh.
const ChannelHealth* FindChannel(const std::vector<ChannelHealth>& channels, ChannelId id);

}  // namespace palace
