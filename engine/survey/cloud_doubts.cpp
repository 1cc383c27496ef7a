#include "engine/survey/cloud_doubts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "engine/core/text.h"

namespace palace {
namespace {

constexpr std::size_t kOneOf = 2000;  // points at either end of an axis that are set aside
constexpr std::size_t kFewestToJudge = 100;
constexpr double kFar = 100;  // times the extent of the others
constexpr double kWidestDegrees = 1;
constexpr int kMostNeighbours = 6;  // of eight

/// Along one axis, without a two-thousandth of the points at either end.
Eigen::Vector2d Inner(const CloudPoints& points, int axis) {
  std::vector<double> along(points.size());
  std::transform(points.begin(), points.end(), along.begin(),
                 [&](const Eigen::Vector3d& p) { return p[axis]; });
  const std::size_t aside = std::max<std::size_t>(1, points.size() / kOneOf);
  const auto low = along.begin() + static_cast<std::ptrdiff_t>(aside);
  const auto high = along.end() - 1 - static_cast<std::ptrdiff_t>(aside);
  std::nth_element(along.begin(), low, along.end());
  const double least = *low;
  std::nth_element(along.begin(), high, along.end());
  return {least, *high};
}

}  // namespace

std::string DoubtOfExtent(const CloudPoints& points, const Eigen::Vector2d& extent,
                          const Lander& lander) {
  const double needed_m = 2 * lander.clear_radius_m();
  if (points.empty() || extent.maxCoeff() >= needed_m) {
    return "";
  }
  const Eigen::Vector2d first = points.front().head<2>().cwiseAbs();
  const bool degrees = extent.maxCoeff() > 0 && extent.maxCoeff() < kWidestDegrees &&
                       first.x() <= 90 && first.y() <= 180;
  return WithNumbers("the points span %.3g m north and %.3g m east, a lander needs %.3g m",
                     extent.x(), extent.y(), needed_m) +
         (degrees ? "; degrees of longitude and latitude look like this: give metres (UTM, or any "
                    "other local projection)"
                  : "; coordinates are taken as metres, x east and y north");
}

std::string DoubtOfFarPoints(const CloudPoints& points, const Eigen::Vector2d& extent) {
  if (points.size() < kFewestToJudge) {
    return "";
  }
  const Eigen::Vector2d north = Inner(points, 0), east = Inner(points, 1);
  const Eigen::Vector2d inner(north.y() - north.x(), east.y() - east.x());
  const double span = inner.maxCoeff();
  if (!(span > 0 && extent.maxCoeff() > kFar * span)) {
    return "";
  }
  const auto far = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
    return p.x() < north.x() - span || p.x() > north.y() + span || p.y() < east.x() - span ||
           p.y() > east.y() + span;
  });
  return WithNumbers(far == 1 ? "%.0f of %.0f points lies far from all others"
                              : "%.0f of %.0f points lie far from all others",
                     static_cast<double>(far), static_cast<double>(points.size())) +
         WithNumbers(", which span %.3g x %.3g m, and make that ", inner.x(), inner.y()) +
         WithNumbers("%.3g x %.3g m; remove them for cells of the size of the rest", extent.x(),
                     extent.y());
}

double SingleGaps::ALander(const Lander& lander, double cell_m) const {
  const double radius_m = lander.clear_radius_m();
  const double cells_m2 = std::max(1, cells) * cell_m * cell_m;
  return gaps * std::numbers::pi * radius_m * radius_m / cells_m2;
}

SingleGaps CountSingleGaps(const CloudPoints& points, const GridGeometry& geometry) {
  Grid<std::uint8_t> has(geometry.rows, geometry.cols, 0);
  for (const Eigen::Vector3d& p : points) {
    if (const auto cell = geometry.CellFromPoint(p.x(), p.y())) {
      has.at(*cell) = 1;
    }
  }
  SingleGaps found;
  for (int r = 0; r < geometry.rows; ++r) {
    for (int c = 0; c < geometry.cols; ++c) {
      if (has.at(r, c) != 0) {
        ++found.cells;
        continue;
      }
      int neighbours = 0;
      for (int k = 0; k < 9; ++k) {
        const Cell near{r + k / 3 - 1, c + k % 3 - 1};
        neighbours += geometry.Contains(near) ? has.at(near) : 0;
      }
      if (neighbours >= kMostNeighbours) {
        ++found.gaps;
        ++found.cells;
      }
    }
  }
  return found;
}

}  // namespace palace
