#include "engine/slad/sites/site_selection.h"

#include <cmath>

#include "engine/slad/sites/site_evaluation.h"
#include "engine/slad/sites/site_registry.h"

namespace palace {

SiteSelection SelectSites(const ElevationMap& map, const HazardMaps& hazards,
                          const SladSettings& settings, const SiteContext& context) {
  return SiteRegistry().Select(map, hazards, settings, context);
}

std::optional<LandingSite> RecheckSite(const ElevationMap& map, const HazardMaps& hazards,
                                       const SladSettings& settings, const LandingSite& site,
                                       const SiteContext& context) {
  PALACE_CHECK(map.geometry == hazards.geometry);
  const auto cell = map.geometry.CellFromPoint(site.p_WS.x(), site.p_WS.y());
  if (map.height_m.empty() || !cell) {
    return std::nullopt;
  }
  LandingSite now =
      EvaluateSite(map, hazards, settings, context, ApproachCorridors(map, settings), *cell);
  now.id = site.id;
  now.letter = site.letter;
  now.reason = site.reason;
  // The place itself stays; only its height may be known better.
  now.p_WS.head<2>() = site.p_WS.head<2>();
  if (std::isnan(now.p_WS.z())) {
    now.p_WS.z() = site.p_WS.z();
  }
  return now;
}

}  // namespace palace
