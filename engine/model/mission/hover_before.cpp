#include "engine/model/mission/hover_before.h"

#include <algorithm>
#include <cmath>

#include "engine/core/units.h"

namespace palace {

FlyTo HoverBefore(const Eigen::Vector3d& p_WB, const Eigen::Vector3d& place_W, double slope_rad) {
  const Eigen::Vector2d way = (place_W - p_WB).head<2>();
  const double down_m = place_W.z() - p_WB.z();
  const double before_m = std::max(0.0, down_m / std::tan(std::clamp(slope_rad, Rad(10), Rad(80))));
  const double go_m = std::max(0.0, way.norm() - before_m);
  const Eigen::Vector2d along = way.norm() > 0 ? Eigen::Vector2d(way.normalized()) : way;
  const Eigen::Vector2d at = p_WB.head<2>() + go_m * along;
  return {{at.x(), at.y(), p_WB.z()}, std::atan2(way.y(), way.x())};
}

}  // namespace palace
