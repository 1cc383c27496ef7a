// The figures of one site on one map. Internal to the SLAD room.
#pragma once

#include "engine/slad/sites/site_selection.h"

namespace palace {

/// All fields of a site centred on the cell but id, letter and reason. The plane of the site is the
/// weighted least-squares plane of the known cells within the lander's radius, those more than
/// three sigmas and the roughness limit off it left out.
LandingSite EvaluateSite(const ElevationMap& map, const HazardMaps& hazards,
                         const SladSettings& settings, const SiteContext& context, Cell cell);

/// A straight way down to a site, as wide as the rotor.
struct Approach {
  Eigen::Vector2d from = Eigen::Vector2d::UnitX();  ///< unit, north and east, away from the site
  double length_m = 0;                              ///< horizontal
  double glide_slope_rad = 0;                       ///< down from the horizon
};

/// True when nothing known stands in the corridor that rises from the site along the approach. An
/// object at distance s along it is met by the rim of a lander whose centre is one lander radius
/// nearer, so it may rise to (s - radius) tan(slope) above the site, plus the roughness limit. A
/// thin structure counts as a metre higher; one whose height is unknown stands in the way of every
/// corridor it crosses.
bool IsClear(const Approach& approach, const ElevationMap& map, const SladSettings& settings,
             const LandingSite& site);

/// The approach straight from the vehicle, or on the planned course: from where its slope is as
/// high as the vehicle, or from the vehicle where that is farther out. Nothing where nobody knows
/// the vehicle, or it is at the site.
std::optional<Approach> ApproachFlown(const SladSettings& settings, const SiteContext& context,
                                      const LandingSite& site);

/// Bit k: clear from sector k of eight (north, north-east, ...), from where the slope is as high as
/// the vehicle, and so is the level way there.
std::uint8_t ClearApproaches(const ElevationMap& map, const SladSettings& settings,
                             const SiteContext& context, const LandingSite& site);

}  // namespace palace
