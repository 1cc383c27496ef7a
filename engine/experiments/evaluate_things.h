// Things of the limits' size on ground drawn anew: which of them SLAD calls hazards, which it says
// it did not see, and which it takes for safe ground.
//
// A trial draws one field of each kind that is asked at each height, sees it in ten pairs from a
// hover and asks of every thing in view: found (a cell that it touches is a hazard), not seen (none
// is, but no place from which the lander would touch it can be confirmed: cells unknown, or too
// little power), or missed. Of bare ground the share of footprints that are refused is counted:
// false alarms. Found at an even lower price of false alarms is better; missed is what kills.
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

Experiment ThingsExperiment();

}  // namespace palace
