#include "gui/panels/session_words.h"

namespace palace {

const char* WhyNoLink(const EngineSnapshot& snap) {
  if (snap.session->can_transmit) {
    return "";
  }
  const char* why = WhyNoVehicle(snap.session->source.kind);
  return *why != '\0' ? why : "No link";
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
