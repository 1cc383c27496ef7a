// `evaluate position-estimate`: the thesis's approach to a road cone (Fig. 3.7), its seven steps
// beside the resection on the same pictures, raw and filtered, by the quality of the attitude.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/simulation/simulator.h"

namespace palace {

Experiment PositionEstimateExperiment(SceneCameraFactory camera);

}  // namespace palace
