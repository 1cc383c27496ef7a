#include "engine/flight/level_way.h"

#include <algorithm>

namespace palace {
namespace {

constexpr double kSigmas = 3;

double TopOf(const ElevationMap& map, Cell cell) {
  const double height_m = static_cast<double>(map.height_m.at(cell)) +
                          kSigmas * std::sqrt(static_cast<double>(map.variance_m2.at(cell)));
  const double thin_m = map.thin_top_m.empty() ? NAN : static_cast<double>(map.thin_top_m.at(cell));
  return std::fmax(height_m, thin_m);
}

}  // namespace

double HighestBelow(const ElevationMap& map, const Eigen::Vector2d& from_W,
                    const Eigen::Vector2d& to_W, double half_width_m) {
  const GridGeometry& g = map.geometry;
  const Eigen::Vector2d way = to_W - from_W;
  const double length_m = way.norm();
  const Eigen::Vector2d along = length_m > 0 ? Eigen::Vector2d(way / length_m) : way;
  double highest_m = NAN;
  for (int row = 0; row < g.rows; ++row) {
    for (int col = 0; col < g.cols; ++col) {
      const Eigen::Vector2d from_start =
          Eigen::Vector2d(g.NorthOfRow(row), g.EastOfCol(col)) - from_W;
      const double s = std::clamp(from_start.dot(along), 0.0, length_m);
      if ((from_start - s * along).norm() <= half_width_m &&
          map.state.at(row, col) != CellState::kUnknown) {
        highest_m = std::fmax(highest_m, TopOf(map, {row, col}));
      }
    }
  }
  return highest_m;
}

double UnseenBelow(const ElevationMap& map, const Eigen::Vector2d& from_W,
                   const Eigen::Vector2d& to_W) {
  const GridGeometry& g = map.geometry;
  const double length_m = (to_W - from_W).norm();
  if (g.rows <= 0 || !(g.cell_m > 0)) {
    return length_m;
  }
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / g.cell_m)));
  int unseen = 0;
  for (int k = 0; k < steps; ++k) {
    const Eigen::Vector2d at = from_W + (k + 0.5) / steps * (to_W - from_W);
    const auto cell = g.CellFromPoint(at.x(), at.y());
    unseen += !cell || map.state.at(*cell) != CellState::kMeasured ? 1 : 0;
  }
  return length_m * unseen / steps;
}

}  // namespace palace
