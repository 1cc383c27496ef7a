#include "engine/runtime/site_review.h"

#include <string>

#include "engine/core/text.h"
#include "engine/mission/site_finding.h"

namespace palace {

SiteReview ReviewSite(const LandingSite& site, const std::optional<LandingSite>& now,
                      const SladSettings& settings) {
  SiteReview review;
  review.letter = site.letter;
  review.reason = "Site ";
  review.reason += site.letter;
  if (!now) {
    review.reason += " is not on this map.";
    return review;
  }
  const SiteFinding found = JudgeRecheck(now, {}, {site.confirmed, site.clearance_m}, settings);
  review.kept = found.holds();
  if (found.finding == Finding::kGood) {
    review.reason +=
        WithNumbers(", where the flight had it, has %.1f m to the nearest hazard, min %.1f m.",
                    now->safe_distance_m, now->clear_radius_m);
  } else {
    review.reason += ": " + found.reason + ".";
  }
  return review;
}

}  // namespace palace
