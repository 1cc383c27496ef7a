#include "gui/panels/session_words.h"

namespace palace {

const char* WhyNoLink(const EngineSnapshot& snap) {
  if (snap.session->can_transmit) {
    return "";
  }
  const char* why = WhyNoVehicle(snap.session->source.kind);
  return *why != '\0' ? why : "No link";
}

}  // namespace palace
