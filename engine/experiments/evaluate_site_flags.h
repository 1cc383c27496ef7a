// `palacectl evaluate site-flags`: what pictures add to heights: wires, painted lines, still water,
// somebody walking, and how often something is flagged where there is nothing.
#pragma once

#include "engine/experiments/experiment.h"

namespace palace {

/// One trial is one field of boxes and cones on one kind of ground, from 30 or 50 ft, straight down
/// or at 45 degrees; textures, heights and tilts take turns. Things are put into it one at a time.
Experiment SiteFlagsExperiment();

/// How the table of all trials is read (site_flags_report.cpp).
ExperimentReport ReportSiteFlags(const TrialTable& table);

}  // namespace palace
