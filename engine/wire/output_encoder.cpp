#include "engine/wire/output_encoder.h"

#include <algorithm>

#include "engine/wire/convert.h"

namespace palace {
namespace {
constexpr double kMissionPeriod_s = 1.0;
}

std::vector<WireMessage> OutputEncoder::Encode(const EngineSnapshot& snapshot) {
  std::vector<WireMessage> messages;
  if (settings_hash_ != snapshot.session->settings_hash) {
    settings_hash_ = snapshot.session->settings_hash;
    messages.push_back(EncodeSettings(snapshot.session->settings, snapshot.time, channels_));
  }
  const auto& map = snapshot.terrain->applied;
  if (map && (map_time_ != map->map_time || map_hash_ != map->map_hash)) {
    map_time_ = map->map_time;
    map_hash_ = map->map_hash;
    messages.push_back(EncodeProposal(*map, snapshot.time, channels_));
  }
  const bool tracking = snapshot.flight->tracker.locked || snapshot.flight->tracker.keyframes > 0;
  if (tracking && tracker_time_ != snapshot.flight->tracker.time) {
    tracker_time_ = snapshot.flight->tracker.time;
    messages.push_back(EncodeTracker(snapshot.flight->tracker, channels_));
    messages.back().time = snapshot.time;
  }
  if (snapshot.session->events) {
    // The list may have lost its oldest, or go on where an engine that stopped had come to.
    const std::vector<Event>& events = *snapshot.session->events;
    const auto is_told = [&](const Event& event) { return event.number <= newest_event_; };
    for (auto event = std::partition_point(events.begin(), events.end(), is_told);
         event != events.end(); ++event) {
      messages.push_back(EncodeEvent(*event, channels_));
      messages.back().time = snapshot.time;
      newest_event_ = event->number;
    }
  }
  const bool due = !mission_time_ || state_ != snapshot.flight->mission.state ||
                   SecondsBetween(*mission_time_, snapshot.time) >= kMissionPeriod_s ||
                   snapshot.time < *mission_time_;
  if (due) {
    mission_time_ = snapshot.time;
    state_ = snapshot.flight->mission.state;
    messages.push_back(EncodeMission(snapshot, channels_));
  }
  messages.push_back(EncodeStationStatus(snapshot, channels_));
  return messages;
}

}  // namespace palace
