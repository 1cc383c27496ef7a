// Dots whose place on the target is known: measured again with what the grid tells, and held
// against the target's description.
#pragma once

#include <map>

#include "engine/calibration/target_observation.h"
#include "engine/core/result.h"
#include "engine/model/calibration_target.h"
#include "engine/model/image.h"

namespace palace {

/// True for the places of the target's points.
bool OnGrid(const CalibrationTarget& target, int column, int row);

/// Measures every dot again with the window its place on the grid gives; drops those that cannot
/// be.
TargetObservation RefineOnGrid(const ImageU8& picture, const CalibrationTarget& target,
                               const TargetObservation& rough);

/// Refuses a target whose dots are more than a fifth wider or narrower than those seen (median,
/// half a pixel of sampling spared): the diameter decides where the background is measured and how
/// far a slanted dot's centroid is from its centre. By area, which blur does not change:
///   diameter / pitch = sqrt(4 area / (pi det(steps)))
/// areas_px: area of every seen dot by its index.
Status CheckDotSize(const CalibrationTarget& target, const TargetObservation& seen,
                    const std::map<int, double>& areas_px);

}  // namespace palace
