// Whether a wave-off is offered on a screen, and sent past an engine that does not answer.
#pragma once

#include <string>

#include "engine/model/snapshot.h"

namespace palace {

/// So long the vehicle may be silent and its last word still stands (guard G1).
inline constexpr double kLinkSilent_s = 1;

/// A word of the vehicle so old says what was, not what is.
inline bool IsWordOld(double age_s) { return age_s > kLinkSilent_s; }

/// Why no wave-off is offered; empty: it is. The snapshot's word counts only while the snapshot is
/// true, `silent_s` since: a vehicle that was said to stand on the ground may have taken off.
std::string WhyNoWaveOff(const EngineSnapshot& snapshot, double silent_s);

}  // namespace palace
