// `evaluate heading`: the course of an approach in drawn wind, sun and obstacles. Is a blocked side
// ever flown, is more tailwind flown than the limit where a clear side keeps it, and is the curve
// over 72 headings that of a slow reference (heading_reference.h)?
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

Experiment HeadingExperiment();

}  // namespace palace
