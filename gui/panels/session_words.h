// Words about the session that several panels say.
#pragma once

#include <string>

#include "engine/model/snapshot.h"

namespace palace {

/// Why nothing can be sent to a vehicle, "No link in replay"; empty when it can.
const char* WhyNoLink(const EngineSnapshot& snap);
/// Who commands the vehicle: "In control: this station, key 3F2A-91C0-77B4-E0D2"; `narrow`: without
/// the fingerprint.
std::string CommandText(const EngineSnapshot& snap, bool narrow);
/// Something came from the vehicle, whether or not it still does; sources on disk always speak.
bool IsHeard(const EngineSnapshot& snap);
/// The source obeys play, pause, steps and speed: what is alive does not wait.
bool CanBePaused(const EngineSnapshot& snap);
/// It plays: neither paused nor at its end.
bool IsPlaying(const EngineSnapshot& snap);
/// Whose time it is, "UTC": simulated time starts at an epoch of its own, and so do logs of it.
const char* ClockName(const EngineSnapshot& snap);

/// What the armed site is to the flight: "Selected", "Landing on", "Looking at", "Landed on", "Was
/// to land on", "Was to look at".
const char* LandingWord(const MissionStatus& mission);

}  // namespace palace
