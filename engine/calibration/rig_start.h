// A first estimate of the whole rig: each camera alone from its closed-form start, then the place
// of the right camera from the boards both see.
#pragma once

#include <vector>

#include "engine/calibration/bundle/bundle_adjustment.h"
#include "engine/calibration/target_observation.h"
#include "engine/core/result.h"
#include "engine/model/calibration_target.h"

namespace palace {

/// One pose a view; views must hold points of one side at least. Refuses, with the reason: cameras
/// that no tilted view tells anything of, fits that leave pixels of error, no common board, and
/// pairs of pictures that contradict each other.
Result<RigEstimate> StartRig(const CalibrationTarget& target, const std::vector<TargetView>& views,
                             int width, int height, const LensPrior& prior);

}  // namespace palace
