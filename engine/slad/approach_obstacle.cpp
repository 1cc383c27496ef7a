#include "engine/slad/approach_obstacle.h"

#include <algorithm>
#include <cmath>

#include "engine/slad/sites/approach_corridors.h"

namespace palace {
namespace {

using Kind = ApproachObstacle::Kind;

/// As long as it is clear, to half a cell; it is not along all its length.
double ClearLength(Approach approach, const ApproachCorridors& corridors, double cell_m,
                   const LandingSite& site) {
  double clear_m = 0, blocked_m = approach.length_m;
  while (blocked_m - clear_m > cell_m / 2) {
    approach.length_m = (clear_m + blocked_m) / 2;
    (corridors.IsClear(approach, site) ? clear_m : blocked_m) = approach.length_m;
  }
  return clear_m;
}

bool IsClearWithoutThin(const Approach& approach, const ElevationMap& map,
                        const SladSettings& settings, const LandingSite& site) {
  ElevationMap ground;
  ground.geometry = map.geometry;
  ground.height_m = map.height_m;
  ground.variance_m2 = map.variance_m2;
  ground.state = map.state;
  return ApproachCorridors(ground, settings).IsClear(approach, site);
}

}  // namespace

std::optional<ApproachObstacle> FindApproachObstacle(const ElevationMap& map,
                                                     const SladSettings& settings,
                                                     const SiteContext& context,
                                                     const LandingSite& site) {
  std::optional<Approach> approach = ApproachFlown(settings, context, site);
  if (site.corridor_clear || !approach) {
    return std::nullopt;
  }
  const ApproachCorridors corridors(map, settings);
  if (corridors.IsClear(*approach, site)) {
    return ApproachObstacle{Kind::kOnLevelWay};
  }
  const GridGeometry& g = map.geometry;
  const double clear_m = ClearLength(*approach, corridors, g.cell_m, site);
  approach->length_m = clear_m + g.cell_m / 2;
  const bool thin = !map.thin_top_m.empty() && IsClearWithoutThin(*approach, map, settings, site);
  const GridF& top_m = thin ? map.thin_top_m : map.height_m;
  ApproachObstacle found{thin ? Kind::kThin : Kind::kStands};
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      const Eigen::Vector2d away =
          Eigen::Vector2d(g.NorthOfRow(r), g.EastOfCol(c)) - site.p_WS.head<2>();
      const double along_m = away.dot(approach->from);
      const double aside_m =
          std::abs(away.x() * approach->from.y() - away.y() * approach->from.x());
      const double rise_m = static_cast<double>(top_m.at(r, c)) - site.height_m.value;
      if (along_m > clear_m && along_m <= approach->length_m &&
          aside_m <= settings.lander.rotor_diameter_m / 2 && !(rise_m <= found.top_m) &&
          !std::isnan(rise_m)) {
        found.top_m = rise_m;
        found.distance_m = away.norm();
        found.bearing_rad = std::atan2(away.y(), away.x());
      }
    }
  }
  return found;
}

}  // namespace palace
