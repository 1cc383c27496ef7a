// Words about the session that several panels say.
#pragma once

#include "engine/model/snapshot.h"

namespace palace {

/// Why nothing can be sent to a vehicle, "No link in replay"; empty when it can.
const char* WhyNoLink(const EngineSnapshot& snap);

}  // namespace palace
