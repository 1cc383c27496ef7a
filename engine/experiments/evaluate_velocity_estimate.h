// `evaluate velocity-estimate`: velocities made from vision fixes, as the thesis made them one way
// after the other (5.1.1, Figures 5.1 and 5.2) and as we do, each flown on in closed loop; and the
// step of the velocity at the hand-over from GPS, in whole missions.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/simulation/simulator.h"

namespace palace {

Experiment VelocityEstimateExperiment(SceneCameraFactory camera);

}  // namespace palace
