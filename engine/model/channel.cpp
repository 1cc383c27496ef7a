#include "engine/model/channel.h"

#include <algorithm>
#include <array>

#include "engine/core/check.h"

namespace palace {

const char* ChannelName(ChannelId id) {
  static constexpr std::array<const char*, kChannelCount> names = {
      "Camera left", "Camera right", "Vehicle pose",   "IMU",
      "GPS",         "Laser range",  "Vehicle status", "Position estimate"};
  const auto index = static_cast<std::size_t>(id);
  PALACE_CHECK(index < names.size(), index);
  return names[index];
}

bool LosesMuch(const ChannelHealth& channel) {
  // The station's own estimate comes as often as it is made, and not over any link.
  return channel.id != ChannelId::kPositionEstimate && channel.lost_share > kMostLostShare;
}

const ChannelHealth* FindChannel(const std::vector<ChannelHealth>& channels, ChannelId id) {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ChannelHealth& channel) { return channel.id == id; });
  return found == channels.end() ? nullptr : &*found;
}

}  // namespace palace
