// What the map shows under a way that is flown level from one hover to another.
//
// The way is every place within `half_width_m` of the straight line between its ends, horizontally.
// A cell's top is the highest of its height with three sigma and of what hangs over it (wires).
// Cells that no camera measured are no ground to fly over safely and none to refuse: their share is
// told beside what is known. Heights up-positive, metres; places north, east in W.
#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"

namespace palace {

struct WayBelow {
  double highest_m = NAN;  ///< of all tops known under it; NaN: none is known
  double unseen_m = 0;     ///< length of the way, along its middle, over ground that was not seen
};

WayBelow LookBelow(const ElevationMap& map, const Eigen::Vector2d& from_W,
                   const Eigen::Vector2d& to_W, double half_width_m);

}  // namespace palace
