// `palacectl evaluate probability`: are touchdowns called safe with probability p safe with share
// p?
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// A trial is one simulated field of ground (touchdown_field.h), kind after kind, with six places
/// to land. Predicted: safe_probability of the hazard maps. Observed: whether the touchdown keeps
/// every limit on the noise-free ground. Reported: the share of safe touchdowns by predicted
/// probability with its Wilson interval, the Brier score, false-safe touchdowns, and the same for
/// each kind of ground with the probabilities re-fitted on all other kinds. Passed when every bin
/// of at least 1,000 touchdowns is within 5 percentage points.
Experiment ProbabilityExperiment();

}  // namespace palace
