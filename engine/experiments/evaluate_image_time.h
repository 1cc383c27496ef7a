// `evaluate image-time`: how soon, and in what wind, wrong image times are found in a hover.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/simulation/simulator.h"

namespace palace {

Experiment ImageTimeExperiment(SceneCameraFactory camera);

}  // namespace palace
