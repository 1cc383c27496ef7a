// Tracker consensus: where the site is by several trackers, and which of them is elsewhere.
//
// Each member that is followed weighs by its coherence, squared. The place with the most weight
// within kDrift_px of it is sought among the members' own places; the consensus is the weighted
// mean of those around it. So one that drifts, however sure of itself, moves nothing (a mean would
// go along with it). What a member is compared with is the consensus of the others: it does not
// vote for itself.
#pragma once

#include <vector>

#include "engine/model/tracker_set_status.h"

namespace palace {

/// Of the members that are followed and do not drift. Not trusted, and no place, where there are
/// none.
TrackerConsensus ConsensusOf(const std::vector<TrackerMember>& members);

/// Of a member by the others: distance from their consensus; NaN with no others, or LOST.
double DisagreementOf(const std::vector<TrackerMember>& members, std::size_t index);

/// Whether the others agree well enough among each other to say that this one is wrong.
bool OthersAgree(const std::vector<TrackerMember>& members, std::size_t index);

/// Sets every member's share of the consensus.
void ShareWeights(const TrackerConsensus& consensus, std::vector<TrackerMember>& members);

/// "Template is 12 px off the others, limit 5 px"; empty when nobody drifts.
std::string DisagreementWords(const std::vector<TrackerMember>& members);

}  // namespace palace
