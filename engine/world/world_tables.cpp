#include "engine/world/world_tables.h"

#include <vector>

namespace palace {

Eigen::Vector2d ReadPlace(TomlTable& table, const char* key) {
  const std::vector<double> place = table.Numbers(key, 2, 2, kPlace);
  return place.size() == 2 ? Eigen::Vector2d(place[0], place[1]) : Eigen::Vector2d::Zero();
}

}  // namespace palace
