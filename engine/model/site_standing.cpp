#include "engine/model/site_standing.h"

#include <algorithm>

#include "engine/core/text.h"

namespace palace {

bool IsInView(const LandingSite& site) { return !(site.age_s > kOldGround_s); }

bool IsAnyInView(const std::vector<LandingSite>& sites) {
  return std::any_of(sites.begin(), sites.end(), IsInView);
}

std::string ClearWords(const LandingSite& site) {
  return WithNumbers("%.1f m clear", site.safe_distance_m) +
         (IsInView(site) ? "" : ", not in view");
}

std::string WhyProvisional(const LandingSite& site, const SladSettings& settings) {
  if (site.confirmed) {
    return {};
  }
  if (site.newest_confirms) {
    return "confirmed by the newest map, sure after 5 in a row";
  }
  const std::string over = WithNumbers("over %.0f cm", 100 * settings.limits.max_deviation_m);
  if (site.hidden_things > kMostHidden) {
    // One line of the narrowest approve panel.
    return WithNumbers("%.2f rocks or holes may be hidden, max %.2f", site.hidden_things,
                       kMostHidden);
  }
  if (settings.mode == SladMode::kModern &&
      !(site.safe_probability >= settings.limits.min_safe_probability)) {
    return WithNumbers("safe probability %.3f, sure from %.3f on", site.safe_probability,
                       settings.limits.min_safe_probability);
  }
  if (!(site.height_m.three_sigma < settings.limits.max_deviation_m)) {
    return WithNumbers("height noise %.1f cm (3 sigma), sure below %.1f cm",
                       100 * site.height_m.three_sigma, 100 * settings.limits.max_deviation_m);
  }
  const int enough = std::min(kFramesToConfirm, settings.fusion.frames_fused);
  if (settings.mode == SladMode::kModern && site.frames_fused < enough && !site.pixel.hasNaN()) {
    return WithNumbers("seen in %.0f of the %.0f frames that it takes", site.frames_fused, enough);
  }
  return "rocks or holes " + over + " may be hidden";
}

}  // namespace palace
