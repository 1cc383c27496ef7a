// What became of a wave-off, by what the vehicle said after it was asked for: its word from before
// says nothing of it. And whether there is anything to wave off.
#pragma once

#include "engine/mission/mission_memory.h"

namespace palace {

/// Why no wave-off is offered, with the age of the vehicle's word; empty: it is. Only a vehicle
/// that says itself, and not longer ago than a link may be silent, that it stands on the ground
/// with its rotor idle needs none: unheard it is still to be waved off.
std::string WhyNoWaveOff(const MissionMemory& memory, Timestamp now);

/// The vehicle's newest status was heard after the newest press of wave-off.
bool HeardSinceWaveOff(const MissionMemory& memory, Timestamp now);
/// Over: it answered, hovers or stands, said so when the climb had time to begin, and is still
/// heard: what it said long ago ends nothing.
bool WaveOffIsOver(const MissionMemory& memory, Timestamp now);
/// Of the newest press; kNone in every state but ABORTING.
WaveOffReport WaveOffNow(const MissionMemory& memory, Timestamp now);

}  // namespace palace
