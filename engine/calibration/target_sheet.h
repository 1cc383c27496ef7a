// A sheet with the calibration target, to be printed at its true size.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/model/calibration_target.h"

namespace palace {

/// SVG in millimetres: the target, a 100 mm bar to check the printer's scale, and a line that says
/// what is to be typed into TARGET.toml. Refuses targets too small or too large to print (a page of
/// 40 mm to 5 m a side).
Result<std::string> TargetSheetSvg(const CalibrationTarget& target);

/// A4 landscape, dots with orientation marks: what --write-target writes unless told otherwise.
CalibrationTarget DefaultTarget();

}  // namespace palace
