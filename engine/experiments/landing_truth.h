// The ground of a world at the place and the moment of a landing, and how a mission ended by it.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/mission/mission_status.h"
#include "engine/model/settings/settings.h"
#include "engine/world/ground_truth.h"
#include "engine/world/world.h"

namespace palace {

/// How a mission ended, held against the truth of its world at the moment it touched down.
///
/// A landing is right when the disc of the vehicle's radius about the true touchdown stays within
/// 1.2 times the hazard limits that the station was given (slope, deviation, step) and touches no
/// water and nothing that moves; else it is on a hazard. The same share of grace as the measurement
/// on unseen ground has, so that figures compare.
enum class MissionOutcome : std::uint8_t {
  kLandedRight,
  kLandedOnHazard,
  kHeld,        ///< in a descent, and nothing could be approved again
  kAborted,     ///< climbed away
  kRefused,     ///< nothing could be approved
  kUnfinished,  ///< time was up in the descent
};
inline constexpr int kMissionOutcomeCount = 6;
inline constexpr double kTruthGrace = 1.2;
const char* MissionOutcomeName(MissionOutcome outcome);
/// Of a mission that ended in `last`: `approved` a site was; `under` the vehicle the ground is so,
/// where it touched down, whether or not the station knows. A landing on ground that nobody knows
/// is one on a hazard.
MissionOutcome OutcomeOf(MissionState last, bool approved, const std::optional<DiscTruth>& under,
                         const TruthLimits& limits);

TruthLimits TruthLimitsOf(const Settings& settings);
/// Of the disc about a place, `time_s` after the start of the simulation.
DiscTruth DiscAt(const World& world, const Eigen::Vector2d& place_m, double radius_m,
                 double time_s);

}  // namespace palace
