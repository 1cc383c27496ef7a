// Air seen: how far up over each cell the cameras have looked.
//
// A wire or a branch hangs over ground that is measured and safe; only a picture with the air over
// that ground in it, far enough off, could have shown it. Over a cell whose ground a camera sees,
// the vertical line is in the picture up to where it leaves the view or comes nearer than thin
// things are looked for: with the camera at p_WC and the line p_C(z) = R^T (q(z) - p_WC),
// q(z) = (north, east, -z), each side of the picture is one linear inequality a + b z >= 0, and so
// is the depth; those with b < 0 bound z from above. The camera's own height bounds it too. Tilted
// 45 degrees, with a field of view of 60 degrees, ground 6 m ahead is seen from 6 m with 2.1 m of
// the air over it, ground 15 m ahead from 15 m with 11 m; straight down from 11 m it is 4 m.
#pragma once

#include "engine/core/frames.h"
#include "engine/model/elevation_map.h"
#include "engine/model/rig.h"

namespace palace {

/// Depth in the camera. Nearer than this the ground's disparity changes too much within a block for
/// paint to cancel, and lines above it leave the right picture: nothing thin is looked for there.
inline constexpr double kNearestThin_m = 7;

/// Raises `seen_up_to_m` (above the origin of W; NaN where nothing was seen) over the cells that
/// `frame` measured, by what the rectified left camera at X_WC had in view. Same cells in both.
void AddAirSeen(const PinholeCamera& camera, const RigidTransform& X_WC, const ElevationMap& frame,
                GridF& seen_up_to_m);

}  // namespace palace
