#include "engine/model/mission/wave_off_offer.h"

namespace palace {

std::string WhyNoWaveOff(const EngineSnapshot& snapshot, double silent_s) {
  return silent_s <= kLinkSilent_s ? snapshot.flight->mission.why_no_wave_off : std::string();
}

}  // namespace palace
