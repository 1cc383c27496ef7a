#include "engine/model/site_standing.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/model/elevation_map.h"

namespace palace {
namespace {

/// Unknown noise hides everything.
bool StandsInNoise(const LandingSite& site, const SladSettings& settings) {
  return !(site.height_m.three_sigma < settings.limits.max_deviation_m);
}

/// "sure from 8 m above it"; where no look from nearer is known to tell, "sure below 10 cm".
std::string SureFrom(const LandingSite& site, const std::string& limit) {
  return "sure " + (std::isfinite(site.look_height_m)
                        ? WithNumbers("from %.0f m above it", site.look_height_m)
                        : limit);
}

/// "0.12 hidden rocks or holes expected, sure from 8 m above it": one line of the narrowest approve
/// panel; near the limit a third digit tells them apart.
std::string MayHide(const LandingSite& site) {
  const bool near_limit = site.hidden_things < 2 * kMostHidden;
  return (near_limit ? WithNumbers("%.3f ", ShownBeyond(site.hidden_things, kMostHidden, 3))
                     : WithNumbers("%.2f ", site.hidden_things)) +
         (IsMarked(site) ? "hidden things expected (unexplained mark), "
                         : "hidden rocks or holes expected, ") +
         (std::isfinite(site.look_height_m)
              ? SureFrom(site, {})
              : WithNumbers(near_limit ? "limit %.3f" : "limit %.2f", kMostHidden));
}

}  // namespace

SiteStanding StandingOf(const LandingSite& site, const SladSettings& settings) {
  return site.confirmed ? SiteStanding::kConfirmed
         : StandsInNoise(site, settings) || site.air_seen_m < kLeastAirSeen_m ||
                 site.hidden_things > kMostHiddenProvisional
             ? SiteStanding::kToLookAt
             : SiteStanding::kProvisional;
}

const char* StandingWord(SiteStanding standing) {
  switch (standing) {
    case SiteStanding::kConfirmed:
      return "Confirmed";
    case SiteStanding::kProvisional:
      return "Provisional";
    case SiteStanding::kToLookAt:
      return "Look first";
  }
  PALACE_CHECK(false);
}

std::string StandingWords(const LandingSite& site, const SladSettings& settings) {
  const SiteStanding standing = StandingOf(site, settings);
  const bool from_nearer = standing == SiteStanding::kToLookAt && std::isfinite(site.look_height_m);
  return from_nearer ? WithNumbers("Look from %.0f m", site.look_height_m) : StandingWord(standing);
}

bool IsAirShown(const LandingSite& site) {
  return !(site.air_seen_m < kLeastAirSeen_m) || site.air_on_way_m >= kLeastAirSeen_m;
}

bool IsMarked(const LandingSite& site) { return (site.flags & kFlagUnexplained) != 0; }

double LookToldAgain(double told_m, double now_m) {
  return std::abs(now_m - told_m) <= kSameLook_m ? told_m : now_m;
}

bool IsInView(const LandingSite& site) { return !(site.age_s > kOldGround_s); }

bool IsAnyInView(const std::vector<LandingSite>& sites) {
  return std::any_of(sites.begin(), sites.end(), IsInView);
}

std::string ClearWords(const LandingSite& site) {
  return WithNumbers("%.1f m clear", site.safe_distance_m) +
         (IsInView(site) ? "" : ", not all in view");
}

std::string WhyProvisional(const LandingSite& site, const SladSettings& settings) {
  if (site.confirmed) {
    return {};
  }
  if (site.newest_confirms) {
    return "confirmed by the newest map, sure after 5 in a row";
  }
  if (StandsInNoise(site, settings)) {
    return WithNumbers("height noise %.1f cm (3 sigma), ", 100 * site.height_m.three_sigma) +
           SureFrom(site, WithNumbers("below %.1f cm", 100 * settings.limits.max_deviation_m)) +
           (IsMarked(site) ? "; an unexplained mark" : "");
  }
  // Air that the way down shows speaks less against it than what may stand there.
  if (site.hidden_things > kMostHiddenProvisional && IsAirShown(site)) {
    return MayHide(site);
  }
  if (site.air_seen_m < kLeastAirSeen_m) {
    const std::string least = WithNumbers("%.0f m", kLeastAirSeen_m);
    return WithNumbers("air over it seen up to %.1f m, ", TenthsDown(site.air_seen_m)) +
           (std::isfinite(site.look_height_m) ? SureFrom(site, {})
            : IsAirShown(site)                ? least + " is seen on the way down"
                                              : least + " takes a look from higher up");
  }
  const std::string over = WithNumbers("over %.0f cm", 100 * settings.limits.max_deviation_m);
  if (site.hidden_things > kMostHidden) {
    return MayHide(site);
  }
  if (settings.mode == SladMode::kModern &&
      !(site.safe_probability >= settings.limits.min_safe_probability)) {
    return WithNumbers("safe probability %.3f, sure from %.3f on", site.safe_probability,
                       settings.limits.min_safe_probability);
  }
  const int enough = std::min(kFramesToConfirm, settings.fusion.frames_fused);
  if (settings.mode == SladMode::kModern && site.frames_fused < enough && !site.pixel.hasNaN()) {
    return WithNumbers("seen in %.0f of the %.0f frames that it takes", site.frames_fused, enough);
  }
  return "rocks or holes " + over + " may be hidden";
}

}  // namespace palace
