// The search: areas of 80 by 80 m full of hazards with one safe place, mostly out of sight, and an
// operator who draws the area and flies the looks that the station proposes.
#pragma once

#include "engine/experiments/experiment.h"
#include "engine/simulation/simulator.h"

namespace palace {

/// A trial is one seed of the world "search", flown from a hover over its middle. Passed when at
/// least 95 % landed right, none on a hazard, and none left the area by more than what a hover
/// strays.
Experiment SearchExperiment(SceneCameraFactory camera);

}  // namespace palace
