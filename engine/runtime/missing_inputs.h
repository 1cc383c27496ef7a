// What maps are made from, and what of it has never come: so that an integrator reads on the screen
// what to send, not only that nothing happens.
#pragma once

#include <string>

#include "engine/model/snapshot.h"

namespace palace {

/// Names of the messages, "CAMERA_RIG with a rig (has_rig 1), VEHICLE_POSE"; empty when all have
/// come once, and for pictures without a vehicle, which need a file instead. Reads role, channels
/// and rig of the snapshot, and the losses.
std::string MissingInputs(const EngineSnapshot& snapshot, const Losses& losses);

}  // namespace palace
