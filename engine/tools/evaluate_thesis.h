// palacectl evaluate thesis: the thesis's figures beside ours, on one page.
#pragma once

#include <vector>

#include "engine/experiments/experiment.h"

namespace palace {

/// Adds `thesis RESULT...` to `evaluate`. A RESULT is a folder or CSV that one of the experiments
/// wrote; what has none is told with the command that makes it.
void AddEvaluateThesis(CLI::App& evaluate, const std::vector<Experiment>& experiments,
                       int& exit_code);

}  // namespace palace
