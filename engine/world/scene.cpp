#include "engine/world/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palace {

double Scene::GroundHeight(double north_m, double east_m) const {
  return std::tan(slope_north_rad) * north_m + std::tan(slope_east_rad) * east_m;
}

double Scene::ObstacleDistance(double north_m, double east_m) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const SceneObject& object : objects) {
    const double dn = north_m - object.north_m, de = east_m - object.east_m;
    double distance;
    if (object.shape == SceneShape::kCone || object.shape == SceneShape::kCylinder) {
      distance = std::hypot(dn, de) - object.size_north_m / 2;
    } else {
      const double c = std::cos(object.yaw_rad), s = std::sin(object.yaw_rad);
      const double x = std::abs(c * dn + s * de) - object.size_north_m / 2;
      const double y = std::abs(-s * dn + c * de) - object.size_east_m / 2;
      distance = std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0);
    }
    nearest = std::min(nearest, std::max(distance, 0.0));
  }
  return nearest;
}

}  // namespace palace
