#include "engine/model/mission/approve_offer.h"

#include <cctype>
#include <cstdio>

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
  const SiteStanding standing = ArmedStanding(mission, settings);
  if (standing == SiteStanding::kConfirmed) {
    return {};
  }
  std::string word = StandingWord(standing);
  word.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(word.front())));
  return ", " + word;
}

}  // namespace palace
