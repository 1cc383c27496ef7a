#include "gui/panels/session_words.h"

#include <algorithm>

namespace palace {

const char* WhyNoLink(const EngineSnapshot& snap) {
  if (snap.session->can_transmit) {
    return "";
  }
  const char* why = WhyNoVehicle(snap.session->source.kind);
  return *why != '\0' ? why : "No link";
}

bool IsHeard(const EngineSnapshot& snap) {
  const std::vector<ChannelHealth>& channels = snap.sensors->channels;
  return snap.session->source.kind != SourceKind::kLive ||
         std::any_of(channels.begin(), channels.end(), [](const ChannelHealth& channel) {
           return channel.id != ChannelId::kPositionEstimate &&  // our own
                  channel.state != ChannelHealth::State::kNever;
         });
}

const char* ClockName(const EngineSnapshot& snap) {
  switch (snap.session->source.kind) {
    case SourceKind::kSimulation:
      return "sim";
    case SourceKind::kReplay:
      return "log";
    case SourceKind::kImages:
      return "set";
    case SourceKind::kVideo:
      return "film";
    default:
      return "UTC";
  }
}

}  // namespace palace
