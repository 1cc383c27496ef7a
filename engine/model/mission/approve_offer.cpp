#include "engine/model/mission/approve_offer.h"

#include <cstdio>

#include "engine/core/check.h"
#include "engine/core/rounding.h"

namespace palace {

std::string WhyScreenOld(double silent_s) {
  if (silent_s <= kScreenOld_s) {
    return {};
  }
  char text[64];
  std::snprintf(text, sizeof text, "Screen %.1f s behind, limit %.1f s", -TenthsDown(-silent_s),
                kScreenOld_s);
  return text;
}

LandingSite ArmedAsKnown(const MissionStatus& mission) {
  const bool lost = mission.armed->confirmed && !mission.armed_confirmed && mission.armed_now;
  LandingSite site = lost ? *mission.armed_now : *mission.armed;
  site.confirmed = !lost && (site.confirmed || mission.armed_confirmed);
  return site;
}

SiteStanding ArmedStanding(const MissionStatus& mission, const SladSettings& settings) {
  return StandingOf(ArmedAsKnown(mission), settings);
}

std::string StandingMark(const MissionStatus& mission, const SladSettings& settings) {
  switch (ArmedStanding(mission, settings)) {
    case SiteStanding::kConfirmed:
      return "";
    case SiteStanding::kProvisional:
      return ", provisional";
    case SiteStanding::kToLookAt:
      return ", not seen enough";
  }
  PALACE_CHECK(false);
}

}  // namespace palace
