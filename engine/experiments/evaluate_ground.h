// Sites on ground nobody drew: fields of every family of worlds, ten pairs each, judged by the
// truth over every touchdown that the navigation error allows.
//
// A trial is one seed: it draws one world and one view a family, at one of the heights in turn. A
// row is a proposed site of the last map, or the field's reason for none. Confirmed and provisional
// sites are counted apart, and so are those over a limit by up to 1.2 times, by more (unsafe) and
// by more than 1.5 times (grossly unsafe).
// Source of the definitions: found-on-unseen-ground.md ("Truth"); intervals: Wilson 1927.
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// Passed when no confirmed site is grossly unsafe and, of `nowhere`, none is offered.
Experiment GroundExperiment();

}  // namespace palace
