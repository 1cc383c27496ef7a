// Events of the faults that are injected into a simulated flight: one where a fault begins to act,
// one where it ends. ActingFaults (mission_status.h) reads them back.
#pragma once

#include <string>
#include <vector>

#include "engine/model/mission/mission_status.h"

namespace palace {

/// Between two moments, by the faults in words that acted before and that act now: what ended, then
/// what began.
std::vector<Event> FaultEvents(const std::vector<std::string>& before,
                               const std::vector<std::string>& now, Timestamp time);

}  // namespace palace
