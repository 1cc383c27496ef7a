// Narrow relief: the height of things smaller than stereo's matching window. Internal to the SLAD
// room.
#pragma once

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"
#include "engine/model/rig.h"

namespace palace {

inline constexpr double kStereoWindow_px = 9;  ///< of stereo's refinement

/// A matching window w metres wide reads a thing s < w wide as lower, by about (s / w)^2, because
/// it averages it with the ground around. Cells that stand above the mean of a ring around them by
/// more than five sigmas are raised to what a thing `narrow_m` wide must then be:
///
///   h += ((w / narrow_m)^2 - 1) (h - ring),   w = 9 px * range / f, factor at most 4
///
/// The ring, 0.75 w + narrow_m / 2 in radius (16 places), takes ordinary slope out. Level ground
/// and noise stay as they are; nothing is lowered; below the height where w reaches narrow_m
/// nothing changes. The variance is left: the sign of the thing is as certain as before.
void RaiseNarrowRelief(const PinholeCamera& camera, const Eigen::Vector3d& p_WC, double narrow_m,
                       ElevationMap& map);

}  // namespace palace
