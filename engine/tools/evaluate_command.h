// palacectl evaluate: experiments with seeds, trial counts and confidence intervals.
#pragma once

#include "engine/simulation/simulator.h"

namespace CLI {
class App;
}

namespace palace {

/// `evaluate landing`: whole missions, one a seed, flown by a scripted operator without a window.
void AddEvaluateCommand(CLI::App& app, int& exit_code, SceneCameraFactory camera);

}  // namespace palace
