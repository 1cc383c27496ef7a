// Rendered calibrations of random rigs against their truth.
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// One calibration a trial: a random pair of CAHVOR cameras, random board poses, blur, noise and
/// uneven light; pictures, dots, bundle adjustment, as palacectl calibrate does. Passed when every
/// trial keeps focal length within 0.05 %, baseline within 0.1 % and rows within 0.05 px rms, and
/// the truth lies inside the stated 3 sigma for 95 % of all parameters.
Experiment CalibrationExperiment();

}  // namespace palace
