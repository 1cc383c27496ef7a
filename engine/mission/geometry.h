// Where the vehicle is against the site: heights, distances, time left. In W (north, east, down),
// by the estimate in force, of the skid centre; NaN where something is not known.
#pragma once

#include <optional>

#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"

namespace palace {

/// Metres above the armed site, up-positive; NaN when none is armed.
double HeightAboveSite(const MissionMemory& memory);

/// Course over ground from the skid centre straight to `p_WS`, clockwise from north.
double HeadingTo(const MissionMemory& memory, const Eigen::Vector3d& p_WS);

/// Glide slope, level leg, settling and the last sink, one after the other, in seconds.
double TimeToTouchdown(double height_m, double distance_m, double descent_rate_mps);

/// Fills height, distance and time left of the status, to the armed site or else the leading one.
void PublishGeometry(MissionMemory& memory, const MissionInputs& inputs);

/// How far the laser's spot lies from the map's height there, in metres.
double LaserMismatch(const MissionInputs& inputs);

/// Horizontal distance of skid centre and site, by the estimate; empty when unknown.
std::optional<double> TouchdownMiss(const MissionMemory& memory);
/// The same by the simulator's truth.
std::optional<double> TrueTouchdownMiss(const MissionMemory& memory, const MissionInputs& inputs);

}  // namespace palace
