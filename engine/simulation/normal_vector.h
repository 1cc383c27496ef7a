// Three independent standard normals.
#pragma once

#include <Eigen/Dense>

#include "engine/core/random.h"

namespace palace {

inline Eigen::Vector3d NormalVector(RandomStream& random) {
  // Named, because the order in which arguments are evaluated is not defined.
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return {x, y, z};
}

}  // namespace palace
