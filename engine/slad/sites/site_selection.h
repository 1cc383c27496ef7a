// Site selection: the best places to land on one map, spaced apart, each with its figures.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "engine/core/frames.h"
#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/landing_site.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// What selection must know beside the maps.
struct SiteContext {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< vehicle, NED metres
  RigidTransform X_WC;                             ///< left camera when the map was made
  PinholeCamera camera;                            ///< rectified left camera; width 0: no picture
  Timestamp time;
  double glide_slope_rad = 0.78539816339;  ///< down from the horizon, for the corridor
  /// Course of an approach that is planned; NaN: straight from the vehicle.
  double approach_heading_rad = std::numeric_limits<double>::quiet_NaN();
};

/// Best first. A site is a cell that can bear the lander: its safe distance reaches the clear
/// radius (lander radius + navigation error) and its footprint keeps every limit. kFarthest ranks
/// by room (RankedRoom, site_candidates.h: the safe distance, less a clear radius for each tenfold
/// by which more may hide there), then cost, then nearness to the middle of the picture; kCost by
/// the smoothed cost. In modern mode kFarthest takes the middle of the touching cells within 3/4 of
/// a cell of the best score. Sites whose straight approach is blocked come after those where it is
/// clear, and last those that no sector of approach is clear to. Sites lie at least site_spacing_m
/// apart. Each has the reason for its rank (GiveReasons, rank_reasons.h) and, in this order, a
/// letter and an id. Pixels come from forward projection (erratum E17); NaN behind the camera. Of
/// one map; what the maps of a flight together say is SiteRegistry's.
SiteSelection SelectSites(const ElevationMap& map, const HazardMaps& hazards,
                          const SladSettings& settings, const SiteContext& context);

/// The same place on a newer map, id and letter kept, clearance negative when it no longer holds.
/// Nothing when the place is outside the map.
std::optional<LandingSite> RecheckSite(const ElevationMap& map, const HazardMaps& hazards,
                                       const SladSettings& settings, const LandingSite& site,
                                       const SiteContext& context);

}  // namespace palace
