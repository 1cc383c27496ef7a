// `evaluate faults`: what is seen, said, blocked and done about each fault between vehicle and
// station, in both phases that matter: a site armed, and the descent.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/simulation/simulator.h"

namespace palace {

Experiment FaultsExperiment(SceneCameraFactory camera);

}  // namespace palace
