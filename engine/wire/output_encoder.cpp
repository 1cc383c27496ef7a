#include "engine/wire/output_encoder.h"

#include "engine/wire/convert.h"

namespace palace {
namespace {
constexpr double kMissionPeriod_s = 1.0;
}

std::vector<WireMessage> OutputEncoder::Encode(const EngineSnapshot& snapshot) {
  std::vector<WireMessage> messages;
  if (settings_hash_ != snapshot.settings_hash) {
    settings_hash_ = snapshot.settings_hash;
    messages.push_back(EncodeSettings(snapshot.settings, snapshot.time, channels_));
  }
  const auto& map = snapshot.applied;
  if (map && (map_time_ != map->map_time || map_hash_ != map->map_hash)) {
    map_time_ = map->map_time;
    map_hash_ = map->map_hash;
    messages.push_back(EncodeProposal(*map, snapshot.time, channels_));
  }
  const bool tracking = snapshot.tracker.locked || snapshot.tracker.keyframes > 0;
  if (tracking && tracker_time_ != snapshot.tracker.time) {
    tracker_time_ = snapshot.tracker.time;
    messages.push_back(EncodeTracker(snapshot.tracker, channels_));
    messages.back().time = snapshot.time;
  }
  if (snapshot.events) {
    // A shorter list is a new flight's.
    const std::vector<Event>& events = *snapshot.events;
    events_ = events.size() < events_ ? 0 : events_;
    for (; events_ < events.size(); ++events_) {
      messages.push_back(EncodeEvent(events[events_], channels_));
      messages.back().time = snapshot.time;
    }
  }
  const bool due = !mission_time_ || state_ != snapshot.mission.state ||
                   SecondsBetween(*mission_time_, snapshot.time) >= kMissionPeriod_s ||
                   snapshot.time < *mission_time_;
  if (due) {
    mission_time_ = snapshot.time;
    state_ = snapshot.mission.state;
    messages.push_back(EncodeMission(snapshot, channels_));
  }
  messages.push_back(EncodeStationStatus(snapshot, channels_));
  return messages;
}

}  // namespace palace
