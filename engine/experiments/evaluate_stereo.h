// palacectl evaluate stereo-accuracy: how well ranges, steps and slopes are measured, beside
// OpenCV.
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// Ray-cast ground of three textures from 10 to 150 ft, nadir and 45 degrees, with 6-inch boxes and
/// 5-degree ramps; our matcher beside OpenCV's SGBM, SGBM-HH and BM on the very same pictures.
/// Trial i is one combination of texture, height, tilt and noise (kStereoTrials cover all); later
/// trials repeat them with other textures. Rows: one a matcher.
Experiment StereoAccuracyExperiment();
inline constexpr int kStereoTrials = 3 * 6 * 2 * 2;

/// `evaluate stereo-cost`: milliseconds a pair against picture size and disparities, beside the
/// same peers in the same run. Times depend on the machine and on what else it does.
Experiment StereoCostExperiment();

}  // namespace palace
