// Whether approve is offered on a screen, and of what: what is approved must be what is seen.
#pragma once

#include <string>

#include "engine/model/mission/mission_status.h"
#include "engine/model/settings/settings.h"
#include "engine/model/site_standing.h"

namespace palace {

/// Figures on the screen are older than the engine's by this much at most.
inline constexpr double kScreenOld_s = 0.5;

/// Why nothing may be approved on a screen that shows a snapshot `silent_s` after it was published:
/// guards pass on newer figures than a person sees. Empty: it may.
std::string WhyScreenOld(double silent_s);

/// The armed site as it is approved: its frozen evidence, confirmed as it is now; where it was
/// confirmed and is so no longer, the newest map's.
LandingSite ArmedAsKnown(const MissionStatus& mission);
SiteStanding ArmedStanding(const MissionStatus& mission, const SladSettings& settings);
/// The same as it stands behind the site's name on the button and in the record: empty,
/// ", provisional", ", not seen enough": what is approved is a landing, so none of them is a verb.
std::string StandingMark(const MissionStatus& mission, const SladSettings& settings);

}  // namespace palace
