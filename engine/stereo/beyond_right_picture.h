// Left of the right picture: ground that only the left camera sees.
//
//   A left pixel x of level ground has its match at x - d, d = f b / Z; for x < d that match lies
//   off the right picture. Stereo then compares farther candidates only, and texture that repeats
//   lets one of them pass: seen, pits of 2.6 m at the picture's left rim. What was never compared
//   with its true match is not measured.
#pragma once

#include "engine/core/frames.h"
#include "engine/model/range_map.h"

namespace palace {

/// Pixels with x < d and a disparity below kFallsAway d become NaN in all layers: all of those with
/// x < kFallsAway d. d is of level ground `ground_height_m` above the origin of W (metres,
/// up-positive), seen from X_WC, the pose of the rectified left camera. Rays at or above the
/// horizon have d = 0: they stay. Ground that falls away more steeply at the rim is given up.
void RefuseBeyondRightPicture(const RigidTransform& X_WC, double ground_height_m, RangeMap& range);

}  // namespace palace
