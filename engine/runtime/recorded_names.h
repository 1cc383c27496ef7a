// Names of sites as the recorded flight gave them, for maps built anew after a jump in its log.
//
// After a jump nobody saw which place was named first, so letters would be handed out afresh. Here
// each site takes id and letter of the place that the record proposed there at that time.
#pragma once

#include <memory>

#include "engine/model/flight_record.h"
#include "engine/model/terrain_decision.h"

namespace palace {

/// `decision` under the names of `proposal`, the newest that is not newer than its map, place by
/// place, nearest first within 1.5 m. A site that the record does not know there has a small
/// letter and an id of its own.
///
/// Which site leads depends on what led before (sites/site_registry.h), which nobody saw either:
/// under the limits of the flight the sites stand in the record's order, unknown ones last.
std::shared_ptr<const TerrainDecision> NamedByRecord(
    std::shared_ptr<const TerrainDecision> decision, const RecordedProposal& proposal,
    bool limits_of_flight);

}  // namespace palace
