// FlyArea: the ground over which the vehicle may be sent, and how high, as the operator drew it.
//
// Asked of every way to another hover, of the way to a site and of the next look. A vehicle that is
// outside may be sent in. What is shown of its edge is in W: north, east; heights above the origin
// of W, up-positive. NaN is outside.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace palace {

struct FlyArea {
  static constexpr std::size_t kFewestCorners = 3, kMostCorners = 32;
  static constexpr double kLeast_m2 = 25;
  static constexpr double kFarthest_m = 1000;  ///< a corner from the origin of W, and the ceiling

  std::vector<Eigen::Vector2d> corners_W;  ///< in their order round, either way
  double ceiling_m = 0;                    ///< the highest that B may be sent to
};

/// Why it is no area; empty when it is one. Its edges do not cross.
std::string WhyNoArea(const FlyArea& area);

double AreaOf_m2(const FlyArea& area);
/// The edge counts as inside.
bool IsInside(const FlyArea& area, const Eigen::Vector2d& p_W);
/// To the nearest point of the edge.
double ToEdge_m(const FlyArea& area, const Eigen::Vector2d& p_W);

/// How far the straight way leaves it at most, horizontally, once it is inside; a way that ends
/// outside leaves it by its end. 0: it stays in.
double LeavesBy_m(const FlyArea& area, const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W);

/// "12.3 m outside the area", "4.0 m above its ceiling", or both; empty: there it is kept to it.
std::string OutsideWords(const FlyArea& area, const Eigen::Vector3d& p_WB);

}  // namespace palace
