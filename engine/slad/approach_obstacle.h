// What stands in an approach that is not clear, found by asking the rule that says so (IsClear,
// slad/sites/approach_corridors.h) of shorter and shorter approaches: the name is of what decided.
#pragma once

#include <optional>

#include "engine/model/approach_obstacle.h"
#include "engine/slad/sites/site_selection.h"

namespace palace {

/// The first thing in the way, from the site on: of the approach that is flown to a site as it was
/// re-checked on this map in this context. Nothing where its corridor and the level way are clear.
std::optional<ApproachObstacle> FindApproachObstacle(const ElevationMap& map,
                                                     const SladSettings& settings,
                                                     const SiteContext& context,
                                                     const LandingSite& site);

}  // namespace palace
