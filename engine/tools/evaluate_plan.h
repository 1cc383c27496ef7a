// palacectl evaluate plan: an experiment as shards for GNU parallel and Slurm.
#pragma once

#include <vector>

#include "engine/experiments/experiment.h"

namespace palace {

/// Adds `plan NAME` to `evaluate` for each experiment, with the options of NAME itself.
void AddEvaluatePlan(CLI::App& evaluate, const std::vector<Experiment>& experiments,
                     int& exit_code);

}  // namespace palace
