// How the table of `evaluate ground` is read: sites of this program by family and height, what
// probabilities said, leave one family out, and beside them the best places of others' rules.
#pragma once

#include <string>

#include "engine/experiments/experiment.h"

namespace palace {

/// What the column `by` reads for sites of this program; others: "thesis" and PeerPlace::rule.
inline constexpr char kByPalace[] = "palace";
/// Name of the column of H at one of kHiddenDensities.
std::string HiddenColumn(double density);

/// Passed when no confirmed site is grossly unsafe and, of `nowhere`, none is offered.
ExperimentReport ReportOfGround(const TrialTable& table);

}  // namespace palace
