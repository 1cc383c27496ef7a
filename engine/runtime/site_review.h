// SiteReview: whether the limits in force keep the site that the flight chose.
#pragma once

#include <optional>

#include "engine/model/snapshot.h"

namespace palace {

/// `site` as the flight chose it, `now` the same place on the newest map under `settings`, empty
/// when it lies outside. Kept by the very rule that guards an armed site (site_finding.h).
SiteReview ReviewSite(const LandingSite& site, const std::optional<LandingSite>& now,
                      const SladSettings& settings);

}  // namespace palace
