// A first estimate of one camera and its target poses, in closed form.
//
// Tsai's radial alignment constraint: a radial distortion moves an image point along the line
// through the picture's centre only, so with (X, Y) from the centre and a planar point (x, y, 0)
//   X (r4 x + r5 y + Ty) = Y (r1 x + r2 y + Tx)
// is linear in five ratios whatever the distortion is, and gives R, Tx, Ty of the view. f and Tz
// then follow from f (r4 x + r5 y + Ty) = Y (r7 x + r8 y + Tz), solved for one f over all views.
// Source: Tsai 1987, "A versatile camera calibration technique", section II.B (coplanar case).
#pragma once

#include <optional>
#include <vector>

#include "engine/calibration/target_observation.h"
#include "engine/core/frames.h"
#include "engine/model/calibration_target.h"

namespace palace {

struct TsaiStart {
  double focal_px = 0;
  std::vector<std::optional<RigidTransform>> X_CT;  ///< nothing where the view gave none
};

/// Square pixels and a centre in the middle of the picture are assumed. Nothing when no view is
/// tilted enough to tell focal length from distance.
std::optional<TsaiStart> StartFromRadialAlignment(const CalibrationTarget& target,
                                                  const std::vector<TargetObservation>& views,
                                                  int width, int height);

}  // namespace palace
