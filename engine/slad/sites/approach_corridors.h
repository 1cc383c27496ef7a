// Straight ways down to a site over one map, and whether something stands in them. Internal to the
// SLAD room.
//
// A corridor rises from the site along the approach, as wide as the rotor. An object at distance s
// along it is met by the rim of a lander whose centre is one lander radius nearer, so it may rise
// to
//   (s - radius) tan(slope) + roughness limit
// above the site. A thin structure counts as a metre higher; one whose height is unknown stands in
// the way of every corridor it crosses. What stands within the clear radius is a hazard anyway.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/slad/sites/site_selection.h"

namespace palace {

/// Sigmas of noise that a height may owe: of the site's plane, of what stands in the corridor.
inline constexpr double kCorridorSigmas = 3;

/// A straight way down to a site, as wide as the rotor.
struct Approach {
  Eigen::Vector2d from = Eigen::Vector2d::UnitX();  ///< unit, north and east, away from the site
  double length_m = 0;                              ///< horizontal
  double glide_slope_rad = 0;                       ///< down from the horizon
};

/// How far out the slope from the site is at the vehicle's height; NaN for a vehicle nobody knows.
double SlopeLength(const SiteContext& context, const LandingSite& site);

/// The approach straight from the vehicle, or on the planned course: from where its slope is as
/// high as the vehicle, or from the vehicle where that is farther out. Nothing where nobody knows
/// the vehicle, or it is at the site.
std::optional<Approach> ApproachFlown(const SladSettings& settings, const SiteContext& context,
                                      const LandingSite& site);

class ApproachCorridors {
 public:
  /// Both must outlive it.
  ApproachCorridors(const ElevationMap& map, const SladSettings& settings);

  /// True when nothing known stands in the corridor, and where the site's height is not known.
  bool IsClear(const Approach& approach, const LandingSite& site) const;
  /// The corridor is clear, and the level way from the vehicle to where it begins.
  bool IsReachable(const Approach& approach, const SiteContext& context,
                   const LandingSite& site) const;
  /// Bit k: reachable from sector k of eight (north, north-east, ...), from where the slope is as
  /// high as the vehicle.
  std::uint8_t ClearSectors(const SiteContext& context, const LandingSite& site) const;

 private:
  bool LevelWayIsClear(const Approach& approach, const SiteContext& context,
                       const LandingSite& site) const;

  const ElevationMap& map_;
  const SladSettings& settings_;
  /// Highest of each row, so that rows in which nothing rises so far are not searched.
  std::vector<double> top_m_;
};

}  // namespace palace
