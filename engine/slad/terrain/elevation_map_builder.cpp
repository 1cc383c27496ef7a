#include "engine/slad/terrain/elevation_map_builder.h"

#include <cmath>

#include "engine/slad/terrain/hole_filling.h"
#include "engine/slad/terrain/terrain_points.h"

namespace palace {

ElevationMap ElevationFromRange(const RangeMap& range, const SladSettings& settings) {
  const TerrainPoints points = PointsFromRange(range);
  const GridGeometry geometry = LayOutGrid(ChooseBounds(points, settings, &range), settings);
  ElevationMap map =
      AccumulateCells(points, geometry, settings.mode, kCorrelatedPixels, range.time);
  map.attitude_sigma_rad = range.pose->sigmas.attitude_rad;
  FillHoles(map, settings.grid.data_size_cells, settings.grid.border_size_cells);
  return map;
}

ElevationMap ElevationFromPoints(const std::vector<Eigen::Vector3d>& p_W,
                                 const std::vector<float>* sigma_m, const SladSettings& settings,
                                 Timestamp time) {
  PALACE_CHECK(sigma_m == nullptr || sigma_m->size() == p_W.size(), p_W.size());
  TerrainPoints points;
  points.reserve(p_W.size());
  for (std::size_t i = 0; i < p_W.size(); ++i) {
    const double sigma = sigma_m == nullptr ? 0.0 : static_cast<double>((*sigma_m)[i]);
    if (p_W[i].allFinite() && std::isfinite(sigma)) {
      points.push_back({p_W[i].x(), p_W[i].y(), HeightFromDown(p_W[i].z()), sigma * sigma});
    }
  }
  const GridGeometry geometry = LayOutGrid(ChooseBounds(points, settings, nullptr), settings);
  ElevationMap map = AccumulateCells(points, geometry, settings.mode, 1, time);
  FillHoles(map, settings.grid.data_size_cells, settings.grid.border_size_cells);
  return map;
}

}  // namespace palace
