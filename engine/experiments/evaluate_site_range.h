// `palacectl evaluate site-range`: the right site against altitude (thesis Table 4.5).
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// One trial is one cone field at every altitude, for each cone size, judged by modern mode from
/// all frames and from the first, and by thesis mode from the first.
Experiment SiteRangeExperiment();

}  // namespace palace
