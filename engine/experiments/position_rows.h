// Rows of `evaluate position-estimate`: one a flight, picture size, attitude and estimator, and of
// the first flight its track twice a second, for plots; and how the table of them is read.
#pragma once

#include <string>
#include <vector>

#include "engine/experiments/experiment.h"
#include "engine/experiments/position_estimators.h"

namespace palace {

struct PositionCase {
  std::string picture;  ///< its size, "640x480"
  bool whole = true;    ///< not the middle rows alone
  std::string attitude;
  std::string estimator;
};

std::vector<std::string> PositionColumns();
void AddPositionRows(const PositionCase& of, const std::vector<PositionSample>& samples,
                     bool with_track, std::vector<TrialRow>& rows);

/// Passed when the resection on whole pictures, filtered, is never more than 0.10 m off with a
/// perfect attitude and 0.25 m with 0.3 deg, and, for each quality of attitude, the mean normalised
/// error squared of its raw and of its filtered positions lies within 0.8 and 1.2; that its interval
/// reaches beyond on either side is said. A flight of which such a figure is unknown, as where the
/// site was never told, does not pass.
ExperimentReport PositionReport(const TrialTable& table);

}  // namespace palace
