// Why a site is only provisional, in words for people.
#pragma once

#include <string>

#include "engine/model/landing_site.h"
#include "engine/model/settings.h"

namespace palace {

/// The first that holds: too little probability, too much noise of height, rocks that may not be
/// seen from there (landing_site.h, confirmed). Empty when the site is confirmed.
std::string WhyProvisional(const LandingSite& site, const SladSettings& settings);

}  // namespace palace
