// Why a site is only provisional, in words for people.
#pragma once

#include <string>

#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// One frame's gaps and blunders are not told from the ground; fewer where frames_fused is less.
inline constexpr int kFramesToConfirm = 3;

/// The first that holds: too little probability, too much noise of height, too few frames, rocks
/// that may not be seen from there (landing_site.h, confirmed). Empty when the site is confirmed.
std::string WhyProvisional(const LandingSite& site, const SladSettings& settings);

}  // namespace palace
