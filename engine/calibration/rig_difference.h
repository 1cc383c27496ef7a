// Two stereo rigs held against each other: what a calibration is off from the truth, or from
// another calibration.
#pragma once

#include "engine/calibration/bundle/bundle_adjustment.h"
#include "engine/model/rig.h"

namespace palace {

/// The rig of two models with the same frame, in the form that is fitted; without target poses. The
/// rig's frame becomes the left camera's own axes. R0 and row shears are dropped, as
/// LensFromCahvor.
RigEstimate RigFromModels(const CahvorModel& left, const CahvorModel& right);

/// a - b in the order of the camera parameters; the rotation as small angles about the axes of C1.
CameraVector RigDifference(const RigEstimate& a, const RigEstimate& b);

}  // namespace palace
