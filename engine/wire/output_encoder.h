// OutputEncoder: what is new in each snapshot, as messages for a bus or a log.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/model/snapshot.h"
#include "engine/wire/channels.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// Settings at the start and when their hash changed, sites with each new map, the tracker with
/// each picture it saw, events once each by their number, MISSION on a change of state and once a
/// second, and always STATION_STATUS, last.
class OutputEncoder {
 public:
  explicit OutputEncoder(ChannelNames channels = {}) : channels_(std::move(channels)) {}
  std::vector<WireMessage> Encode(const EngineSnapshot& snapshot);

 private:
  ChannelNames channels_;
  std::optional<std::uint64_t> settings_hash_;
  std::optional<Timestamp> map_time_;
  std::uint64_t map_hash_ = 0;
  std::optional<Timestamp> tracker_time_;
  std::optional<Timestamp> mission_time_;
  MissionState state_ = MissionState::kNoLive;
  std::uint64_t newest_event_ = 0;
};

}  // namespace palace
