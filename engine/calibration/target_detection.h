// Finding the target in a picture.
#pragma once

#include "engine/calibration/target_observation.h"
#include "engine/core/result.h"
#include "engine/model/calibration_target.h"
#include "engine/model/image.h"

namespace palace {

/// Every point of the target that can be seen, each once. Dots may be missed or hidden; without
/// orientation marks every border row and column must show at least one dot, because the grid's
/// extent is then what places it. A board without marks looks the same turned by half (a square
/// one by a quarter): the turn whose x axis points most to the right of the picture is taken.
/// Errors say what was seen instead ("9 x 6, the target has 13 x 10"). Pictures up to 100
/// megapixels.
Result<TargetObservation> DetectTarget(const ImageU8& picture, const CalibrationTarget& target);

/// Turns `right` by half or quarter turns until its axes point the same way in the picture as
/// those of `left`, so that both cameras number the same dots alike. Nothing to do with marks.
/// Assumes less than a quarter turn of roll between the cameras (half of that for square boards).
void MatchTurn(const CalibrationTarget& target, const TargetObservation& left,
               TargetObservation& right);

}  // namespace palace
