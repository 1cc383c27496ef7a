// Why a site is only provisional, in words for people.
#pragma once

#include <string>
#include <vector>

#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// One frame's gaps and blunders are not told from the ground; fewer where frames_fused is less.
inline constexpr int kFramesToConfirm = 3;

/// Nothing is approved on ground measured longer ago, as old as a map may be.
inline constexpr double kOldGround_s = 2;

/// Its ground was measured no longer ago.
bool IsInView(const LandingSite& site);
bool IsAnyInView(const std::vector<LandingSite>& sites);

/// "3.1 m clear", with ", not in view" where the ground is older than that.
std::string ClearWords(const LandingSite& site);

/// Rocks and holes over the limit expected unseen (LandingSite::hidden_things) under a confirmed
/// site, at most.
inline constexpr double kMostHidden = 0.01;

/// The first that holds: too much that may hide, too little probability, too much noise of height,
/// too few frames, cells wider than a rock (landing_site.h, confirmed). Empty when the site is
/// confirmed.
std::string WhyProvisional(const LandingSite& site, const SladSettings& settings);

}  // namespace palace
