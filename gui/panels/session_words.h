// Words about the session that several panels say.
#pragma once

#include "engine/model/snapshot.h"

namespace palace {

/// Why nothing can be sent to a vehicle, "No link in replay"; empty when it can.
const char* WhyNoLink(const EngineSnapshot& snap);
/// Something came from the vehicle, whether or not it still does; sources on disk always speak.
bool IsHeard(const EngineSnapshot& snap);
/// Whose time it is, "UTC": simulated time starts at an epoch of its own, and so do logs of it.
const char* ClockName(const EngineSnapshot& snap);

}  // namespace palace
