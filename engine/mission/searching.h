// Searching: what was looked at is remembered, and the look that promises most is proposed.
//
// In this order, as far as it may be flown (WhyNotThere), the last two while fuel or battery last
// longer than the reserve (MissionSettings::energy_reserve_s):
//  1. what a site lacks that cannot be approved without it: air that was seen over it, from higher
//     up (of the armed site; else of the one that leads);
//  2. a place that was proposed and did not last, from where the cameras look at its middle;
//  3. ground that was not looked at yet (search/search_plan.h), inside the area that the operator
//     drew, else within SeenGround::kSearched_m of where the hover began.
// Nothing is flown unasked.
#pragma once

#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"

namespace palace {

/// With each new map.
void RememberGround(MissionMemory& memory, const MissionInputs& inputs);
/// Fills next_look and why_no_look of the status. Last in a step; at most once a second, and at
/// once where none may be flown any more.
void PlanSearch(MissionMemory& memory, Timestamp now);

/// A way there is flown now: it is not proposed again.
void RememberLook(MissionMemory& memory, const FlyTo& there);

}  // namespace palace
