// Why each site has its rank, in words. Internal to the SLAD room.
#pragma once

#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Fills `reason` of every site, in the units of what decided: metres of clear radius, cost, or the
/// corridor. The first says what it has over the next, the others what they lack against the best.
/// "the best" and "the next" become letters in SiteRegistry::Select. With less than `tight_m`
/// beyond its clear radius a site ranks behind those that have more.
void GiveReasons(SiteRanking ranking, double tight_m, SiteSelection& selection);

}  // namespace palace
