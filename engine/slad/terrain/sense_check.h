// Whether a map, its cells and the settings make sense at all. What does not gets no site and says
// why; no figure made from it is trusted.
#pragma once

#include <string>

#include "engine/model/elevation_map.h"
#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Empty, or what is wrong: a setting that is no number or negative ("slad.nav_error_m = -1 makes
/// no sense, limits 0 to 5"), no lander, layers of other sizes than the grid, cells below a
/// millimetre or wider than two landers, inside which nothing is known.
std::string ObjectionTo(const ElevationMap& map, const SladSettings& settings);

/// Whether all layers have the grid's size; those that may be left out, when they are there.
bool LayersFit(const ElevationMap& map);

/// The lander with sizes that a map of this grid can be measured with: from 0 to twice the map's
/// width, which is as good as any larger one; what is no number becomes that width.
Lander WithinReason(const Lander& lander, const GridGeometry& geometry);

/// Heights beyond this are no ground: a float's last digit is a centimetre there.
inline constexpr double kHighestGround_m = 1e5;

/// Whether every figure that a site needs is finite, and its height ground.
bool IsSound(const LandingSite& site);

}  // namespace palace
