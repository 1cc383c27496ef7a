// What a point cloud shows of mistakes in it: degrees for metres, points far from all others, cells
// that no point fell into by chance.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/model/grid.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Points of a cloud, X north, Y east, Z up, metres.
using CloudPoints = std::vector<Eigen::Vector3d>;

/// The cloud has less room than a lander needs; empty: it has more. `extent` is north, east,
/// metres.
std::string DoubtOfExtent(const CloudPoints& points, const Eigen::Vector2d& extent,
                          const Lander& lander);

/// A few points of a thousand make the extent a hundred times what the others have; empty: none do.
std::string DoubtOfFarPoints(const CloudPoints& points, const Eigen::Vector2d& extent);

/// Empty cells that have points in six or more of their eight neighbours: where points are
/// scattered at random some are, and each is unknown ground. Shadows, water and the outside are not
/// meant.
struct SingleGaps {
  int gaps = 0;
  int cells = 0;  ///< with points, and gaps
  /// Expected in the area of a lander.
  double ALander(const Lander& lander, double cell_m) const;
};
SingleGaps CountSingleGaps(const CloudPoints& points, const GridGeometry& geometry);

}  // namespace palace
