// What palacectl calibrate writes about a calibration: calibration.json for programs, report.html
// for people.
#pragma once

#include <string>
#include <vector>

#include "engine/calibration/calibration.h"
#include "engine/model/calibration_target.h"

namespace palace {

/// One criterion of acceptance, measured.
struct Criterion {
  bool passed = false;
  std::string text;  ///< with figure, limit and unit
};

/// Row error after alignment, held-out residual against the fitted ones, and how well focal length
/// and baseline are known.
std::vector<Criterion> Acceptance(const Calibration& calibration);

struct CalibrationNotes {
  std::vector<std::string> unseen;  ///< pictures without a target, with the reason
  std::string target_file;
};

/// Units in the names; the parameters' covariance row by row in the order of `parameters`.
std::string CalibrationToJson(const Calibration& calibration, const CalibrationTarget& target,
                              const CalibrationNotes& notes);
std::string CalibrationToHtml(const Calibration& calibration, const CalibrationTarget& target,
                              const CalibrationNotes& notes);

}  // namespace palace
