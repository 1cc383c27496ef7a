// Hashes that say two flights were the same: of what was decided, not of how long it took.
#pragma once

#include <cstdint>

#include "engine/model/snapshot.h"

namespace palace {

/// Of maps, sites, mission state, estimates and settings. Timings and ages of arrival stay out.
std::uint64_t DecisionHash(const EngineSnapshot& snapshot);
/// Of the calibration: every number that decides where a pixel points.
std::uint64_t HashOf(const StereoRig& rig);

}  // namespace palace
