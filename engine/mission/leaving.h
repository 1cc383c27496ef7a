// What a vehicle does when its station leaves, for the question before it does.
#pragma once

#include <string>

#include "engine/model/snapshot.h"

namespace palace {

/// By the duties of a vehicle (engine/wire/README.md) and the limits in force. Empty where nobody
/// has to be asked: nothing flies, or it is not ours to leave.
std::string WhatTheVehicleDoesAlone(const EngineSnapshot& snapshot);

}  // namespace palace
