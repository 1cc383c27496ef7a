#include "gui/panels/session_words.h"

#include <algorithm>

#include "gui/widgets/number_text.h"

namespace palace {

const char* WhyNoLink(const EngineSnapshot& snap) {
  if (snap.session->can_transmit) {
    return "";
  }
  const char* why = WhyNoVehicle(snap.session->source.kind);
  return *why != '\0' ? why : "No link";
}

std::string CommandText(const EngineSnapshot& snap, bool narrow) {
  using Standing = AuthorityStanding;
  const AuthorityStatus& authority = snap.session->authority;
  if (!snap.session->can_transmit) {
    return "Watching";
  }
  const bool live = snap.session->source.kind == SourceKind::kLive;
  const std::string key =
      narrow || !live || authority.fingerprint.empty() ? "" : ", key " + authority.fingerprint;
  switch (authority.standing) {
    case Standing::kNone:
    case Standing::kHeld:
      return "In control: this station" + key;
    case Standing::kNoKey:
      return "View only: no key";
    case Standing::kNoGrant:
      return "View only: the vehicle grants no command" + key;
    case Standing::kAsking:
      return "Asking for command" + key;
    case Standing::kOther:
      return "In control: " + authority.holder +
             (authority.holder_is_silent ? ", silent for " + Duration(authority.holder_silent_s)
                                         : "");
    case Standing::kReleased:
      return "Nobody in control" + key;
  }
  return {};
}

bool IsHeard(const EngineSnapshot& snap) {
  const std::vector<ChannelHealth>& channels = snap.sensors->channels;
  return snap.session->source.kind != SourceKind::kLive ||
         std::any_of(channels.begin(), channels.end(), [](const ChannelHealth& channel) {
           return channel.id != ChannelId::kPositionEstimate &&  // our own
                  channel.state != ChannelHealth::State::kNever;
         });
}

bool CanBePaused(const EngineSnapshot& snap) {
  const SourceKind kind = snap.session->source.kind;
  return kind != SourceKind::kLive && kind != SourceKind::kCameras;
}

bool IsPlaying(const EngineSnapshot& snap) {
  return !snap.session->source.paused && !snap.session->source.ended;
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
      return snap.sensors->vehicle && snap.sensors->vehicle->simulated ? "sim" : "UTC";
  }
}

const char* LandingWord(const MissionStatus& mission) {
  const MissionState state = mission.state;
  return IsFlying(state)                  ? (mission.IsLook() ? "Looking at" : "Landing on")
         : state == MissionState::kLanded ? "Landed on"
         : state >= MissionState::kHold   ? (mission.IsLook() ? "Was to look at" : "Was to land on")
                                          : "Selected";
}

}  // namespace palace
