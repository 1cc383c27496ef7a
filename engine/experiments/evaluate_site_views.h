// `palacectl evaluate site-views`: one field from many viewpoints, one site (the thesis's claim
// that its choice repeats).
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// One trial is one field seen from many places, headings, heights and tilts.
Experiment SiteViewsExperiment();

}  // namespace palace
