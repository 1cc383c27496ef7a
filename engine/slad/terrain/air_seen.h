// Air seen: how far up over each cell the cameras have looked.
//
// A wire or a branch hangs over ground that is measured and safe; only a picture with the air over
// that ground in it could have shown it. Over a cell whose ground a camera sees, the vertical line
// is in the picture up to where it leaves the view: with the camera at p_WC and the line
// p_C(z) = R^T (q(z) - p_WC), q(z) = (north, east, -z), each side of the picture is one linear
// inequality a + b z >= 0, of which those with b < 0 bound z from above. The camera's own height
// bounds it too. From 6 m, tilted 45 degrees, with a field of view of 60 degrees, ground 6 m ahead
// is seen with 4.4 m of the air over it; from 15 m, 15 m ahead, with 11 m.
#pragma once

#include "engine/core/frames.h"
#include "engine/model/elevation_map.h"
#include "engine/model/rig.h"

namespace palace {

/// Raises `seen_up_to_m` (above the origin of W; NaN where nothing was seen) over the cells that
/// `frame` measured, by what the rectified left camera at X_WC had in view. Same cells in both.
void AddAirSeen(const PinholeCamera& camera, const RigidTransform& X_WC, const ElevationMap& frame,
                GridF& seen_up_to_m);

}  // namespace palace
