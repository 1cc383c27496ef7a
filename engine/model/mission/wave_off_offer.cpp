#include "engine/model/mission/wave_off_offer.h"

namespace palace {

std::string WhyNoWaveOff(const EngineSnapshot& snapshot, double silent_s) {
  return IsWordOld(silent_s) ? std::string() : snapshot.flight->mission.why_no_wave_off;
}

}  // namespace palace
