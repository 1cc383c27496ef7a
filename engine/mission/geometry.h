// Where the vehicle is against the site: heights, distances, time left. In W (north, east, down),
// by the estimate in force, of the skid centre; NaN where something is not known.
#pragma once

#include <optional>

#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"

namespace palace {

/// Metres above the armed site, up-positive; NaN when none is armed.
double HeightAboveSite(const MissionMemory& memory);

/// The armed site, else the one that leads; null when there is none.
const LandingSite* SiteInQuestion(const MissionMemory& memory);

/// Freezes the way to the armed site as soon as the vehicle's place is known: straight, by the
/// settings then in force. Approval, button, plots and vehicle take it from there.
void PlanApproach(MissionMemory& memory);

/// Wind as the vehicle measures it, m/s; NaN where it says none or is silent.
double KnownWind(const MissionMemory& memory, Timestamp now);

/// Fills height, distance, time left and the path of the status, to the site in question.
void PublishGeometry(MissionMemory& memory, const MissionInputs& inputs);
/// Fills the limits of the status: value, limit, who enforces it.
void PublishLimits(MissionMemory& memory, const MissionInputs& inputs);

/// How far the laser's spot lies from the map's height there, in metres.
double LaserMismatch(const MissionInputs& inputs);

/// Horizontal distance of skid centre and site, by the estimate; empty when unknown.
std::optional<double> TouchdownMiss(const MissionMemory& memory);
/// The same by the simulator's truth.
std::optional<double> TrueTouchdownMiss(const MissionMemory& memory, const MissionInputs& inputs);

}  // namespace palace
