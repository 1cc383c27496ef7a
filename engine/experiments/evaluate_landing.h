// Whole missions, one a trial: where they land and how well the vision estimate followed the truth.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/simulation/simulator.h"

namespace palace {

/// Flown by a scripted operator, engine and simulator in lockstep. Passed when every mission
/// landed.
Experiment LandingExperiment(SceneCameraFactory camera);

}  // namespace palace
