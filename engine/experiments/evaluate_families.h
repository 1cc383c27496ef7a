// Whole missions on every family of worlds: a trial is one seed, flown once in each world it gives.
// The true starting point of anything that claims to land better on ground nobody drew.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/simulation/simulator.h"

namespace palace {

/// Flown by a scripted operator who arms the best site and approves it when every guard passes.
/// Passed when no mission landed on a hazard.
Experiment FamiliesExperiment(SceneCameraFactory camera);

}  // namespace palace
