// What a vehicle does when its station leaves, for the question before it does.
#pragma once

#include <string>

#include "engine/model/snapshot.h"

namespace palace {

/// By the duties of a vehicle (engine/wire/README.md) and the limits in force, with the age of the
/// vehicle's word where it is old; `silent_s` since the snapshot. Empty where nobody has to be
/// asked: nothing flies, or another station, or none, commands it.
std::string WhatTheVehicleDoesAlone(const EngineSnapshot& snapshot, double silent_s = 0);

}  // namespace palace
