// What the map shows under a way that is flown level from one hover to another.
//
// A cell's top is the highest of its height with three sigma and of what hangs over it (wires).
// Cells that no camera measured are no ground to fly over safely and none to refuse: their length
// is told beside what is known. Heights up-positive, metres; places north, east in W.
#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"

namespace palace {

/// The highest top known within `half_width_m` of the straight line, horizontally; NaN: none is.
double HighestBelow(const ElevationMap& map, const Eigen::Vector2d& from_W,
                    const Eigen::Vector2d& to_W, double half_width_m);

/// Length of the line that lies over ground which was not measured, or off the map.
double UnseenBelow(const ElevationMap& map, const Eigen::Vector2d& from_W,
                   const Eigen::Vector2d& to_W);

}  // namespace palace
