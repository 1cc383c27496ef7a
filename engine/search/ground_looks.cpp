#include "engine/search/ground_looks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/frames.h"

namespace palace {

SeenGround NothingSeen(const Eigen::Vector2d& middle_W) {
  const int side = static_cast<int>(2 * SeenGround::kHalfSide_m / SeenGround::kSquare_m);
  // On whole squares of W, so that the ground is cut the same wherever the hover begins.
  const auto least = [](double at) {
    return std::floor(at / SeenGround::kSquare_m) * SeenGround::kSquare_m - SeenGround::kHalfSide_m;
  };
  return {middle_W,
          {side, side, SeenGround::kSquare_m, least(middle_W.x()), least(middle_W.y())},
          Grid<std::uint8_t>(side, side, 0)};
}

void AddLook(SeenGround& seen, const GroundView& view, const FlyTo& from) {
  const auto here = seen.squares.CellFromPoint(from.p_WB.x(), from.p_WB.y());
  if (!here) {
    return;
  }
  const double below_m = HeightFromDown(from.p_WB.z()) - seen.ground_m;
  for (const Cell& step : SquaresInView(view, from.heading_rad, below_m)) {
    const Cell square{here->row + step.row, here->col + step.col};
    if (seen.squares.Contains(square)) {
      std::uint8_t& maps = seen.maps.at(square);
      maps = static_cast<std::uint8_t>(std::min<int>(maps + 1, SeenGround::kMapsOfALook));
    }
  }
}

bool IsLookedAt(const SeenGround& seen, const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W,
                double half_width_m) {
  const Eigen::Vector2d way = to_W - from_W;
  const double length_m = way.norm();
  const Eigen::Vector2d along = length_m > 0 ? Eigen::Vector2d(way / length_m) : way;
  const Eigen::Vector2d aside(-along.y(), along.x());
  const auto steps = [](double span_m) {  // four in a square: none that is crossed is left out
    return std::max(1, static_cast<int>(std::ceil(4 * span_m / SeenGround::kSquare_m)));
  };
  const int lengthwise = steps(length_m), across = steps(2 * half_width_m);
  for (int i = 0; i <= lengthwise; ++i) {
    for (int k = 0; k <= across; ++k) {
      const Eigen::Vector2d at = from_W + i * length_m / lengthwise * along +
                                 (2.0 * k / across - 1) * half_width_m * aside;
      const auto square = seen.squares.CellFromPoint(at.x(), at.y());
      if (!square || !seen.IsLookedAt(*square)) {
        return false;
      }
    }
  }
  return true;
}

std::vector<Cell> SquaresInView(const GroundView& view, double heading_rad, double below_m) {
  std::vector<Cell> squares;
  const double camera_below_m = below_m - view.p_BC().z();
  if (!(camera_below_m > 0)) {
    return squares;
  }
  const double far_m = view.Reach_m(camera_below_m) + view.p_BC().head<2>().norm();
  const int reach =
      static_cast<int>(std::min(std::ceil(far_m / SeenGround::kSquare_m), SeenGround::kHalfSide_m));
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  for (int row = -reach; row <= reach; ++row) {
    for (int col = -reach; col <= reach; ++col) {
      const double north_m = -row * SeenGround::kSquare_m, east_m = col * SeenGround::kSquare_m;
      if (view.Shows({north_m * c + east_m * s, east_m * c - north_m * s, below_m})) {
        squares.push_back({row, col});
      }
    }
  }
  return squares;
}

}  // namespace palace
