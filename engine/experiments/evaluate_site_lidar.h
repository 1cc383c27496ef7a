// Labelled lidar: which cells of objects and which of ground become hazards, beside plain 3x3
// passes over the same raster.
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// Trial i is the i-th file of x y z label in --data, in the order of names. Cells of 1 m, of 2.5 m
/// where there is less than one point in 2 m^2. A cell is what its highest point is.
Experiment SiteLidarExperiment();

}  // namespace palace
