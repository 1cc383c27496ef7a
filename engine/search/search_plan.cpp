#include "engine/search/search_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/units.h"
#include "engine/search/ground_looks.h"

namespace palace {
namespace {

constexpr int kSides = 8;
constexpr double kEighth_rad = 2 * std::numbers::pi / kSides;
constexpr double kTurn_radps = Rad(30);
constexpr double kSpeed_mps = 2, kUnseen_mps = 0.5;
constexpr double kLook_s = 6;
/// A way as long as the ground that is seen from here is deep, and one half as long.
constexpr double kShares[] = {0.5, 1};

bool IsSearched(const SearchGround& g, const Eigen::Vector2d& at) {
  return g.area != nullptr ? IsInside(*g.area, at)
                           : (at - g.seen.middle_W).norm() <= SeenGround::kSearched_m;
}

/// Squares that are searched and were not looked at.
Grid<std::uint8_t> SquaresLeft(const SearchGround& g) {
  const GridGeometry& squares = g.seen.squares;
  Grid<std::uint8_t> left(squares.rows, squares.cols, 0);
  for (int row = 0; row < squares.rows; ++row) {
    for (int col = 0; col < squares.cols; ++col) {
      left.at(row, col) = !g.seen.IsLookedAt({row, col}) &&
                          IsSearched(g, {squares.NorthOfRow(row), squares.EastOfCol(col)});
    }
  }
  return left;
}

constexpr double kSquare_m2 = SeenGround::kSquare_m * SeenGround::kSquare_m;

double Seconds(const SearchGround& g, const FlyTo& from, const FlyTo& to) {
  const Eigen::Vector2d way = (to.p_WB - from.p_WB).head<2>();
  double seconds = kLook_s + way.norm() / kSpeed_mps;
  // It flies with its cameras ahead, and turns at the end.
  const double along_rad = way.norm() > 0 ? std::atan2(way.y(), way.x()) : from.heading_rad;
  seconds += (std::abs(WrapAngle(along_rad - from.heading_rad)) +
              std::abs(WrapAngle(to.heading_rad - along_rad))) /
             kTurn_radps;
  const int steps = static_cast<int>(std::ceil(way.norm()));
  for (int k = 0; k < steps; ++k) {
    const Eigen::Vector2d at = from.p_WB.head<2>() + (k + 0.5) / steps * way;
    const auto square = g.seen.squares.CellFromPoint(at.x(), at.y());
    if (!square || !g.seen.IsLookedAt(*square)) {
      seconds += way.norm() / steps / kUnseen_mps;
    }
  }
  return seconds;
}

struct Weighed {
  SearchLook look;
  double worth = 0;
};

/// As near to each other as two of one hover's looks are not.
bool IsSameLook(const FlyTo& a, const FlyTo& b) {
  constexpr double kNear_m = 2;
  return (a.p_WB - b.p_WB).norm() < kNear_m &&
         std::abs(WrapAngle(a.heading_rad - b.heading_rad)) < kEighth_rad / 2;
}

}  // namespace

double LeftToSee_m2(const SearchGround& ground) {
  const Grid<std::uint8_t> left = SquaresLeft(ground);
  double left_m2 = 0;
  for (const std::uint8_t square : left.cells()) {
    left_m2 += square * kSquare_m2;
  }
  return left_m2;
}

std::optional<SearchLook> NextLook(const SearchGround& g, const FlyTo& now,
                                   const std::function<bool(const FlyTo&)>& may_fly,
                                   const FlyTo* before) {
  const Grid<std::uint8_t> left = SquaresLeft(g);
  const GridGeometry& squares = g.seen.squares;
  const double below_m = HeightFromDown(now.p_WB.z()) - g.seen.ground_m;
  const double reach_m = g.view.Reach_m(below_m - g.view.p_BC().z());
  std::array<double, kSides> heading_rad{};
  std::array<std::vector<Cell>, kSides> in_view;
  for (std::size_t k = 0; k < kSides; ++k) {
    heading_rad[k] = WrapAngle(now.heading_rad + static_cast<double>(k) * kEighth_rad);
    in_view[k] = SquaresInView(g.view, heading_rad[k], below_m);
  }
  std::vector<Eigen::Vector3d> hovers = {now.p_WB};
  for (const double share : kShares) {
    for (const double side_rad : heading_rad) {
      hovers.push_back(now.p_WB + share * reach_m *
                                      Eigen::Vector3d(std::cos(side_rad), std::sin(side_rad), 0));
    }
  }
  std::vector<Weighed> looks;
  for (const Eigen::Vector3d& p_WB : hovers) {
    const auto here = squares.CellFromPoint(p_WB.x(), p_WB.y());
    for (std::size_t k = 0; here && k < kSides; ++k) {
      double new_m2 = 0;
      for (const Cell& step : in_view[k]) {
        const Cell square{here->row + step.row, here->col + step.col};
        new_m2 += squares.Contains(square) ? left.at(square) * kSquare_m2 : 0;
      }
      if (new_m2 >= kLeastNew_m2) {
        const FlyTo to{p_WB, heading_rad[k]};
        const double takes_s = Seconds(g, now, to);
        const double stays = before != nullptr && IsSameLook(to, *before) ? kBetter : 1;
        looks.push_back({{to, new_m2, takes_s}, stays * new_m2 / takes_s});
      }
    }
  }
  std::stable_sort(looks.begin(), looks.end(),
                   [](const Weighed& a, const Weighed& b) { return a.worth > b.worth; });
  for (const Weighed& weighed : looks) {
    if (may_fly(weighed.look.to)) {
      return weighed.look;
    }
  }
  return std::nullopt;
}

}  // namespace palace
