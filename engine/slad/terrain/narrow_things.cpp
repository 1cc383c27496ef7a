#include "engine/slad/terrain/narrow_things.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/frames.h"
#include "engine/slad/side_by_side.h"
#include "engine/slad/terrain/ground_bumps.h"
#include "engine/slad/terrain/square_and_frame.h"

namespace palace {
namespace {

constexpr int kPerCell = NarrowFigures::kPerCell;
/// Width of the thing that must not hide: half as wide again as it is high, at 1.2 times the
/// default limit; and the share of its height that it shows unsmeared.
constexpr double kThing_m = 0.18, kPeakOfThing = 0.8;
constexpr double kWorstTexture = 2.5;  // times the error that stereo's window usually repeats
constexpr double kGradient_px = 3;     // width that a five-point derivative feels
constexpr double kTallest_m = 1;
/// What stands out does so until it falls below: of the fifty frames that a map remembers one is
/// new, and a bump on the threshold would come and go.
constexpr double kStillStandsOut_sigmas = 3.5;
/// Squares that are looked at, the narrowest last: times the side, and how far their frame reaches.
struct Scale {
  int sides, ring_to;
};
constexpr Scale kScales[] = {{4, 2}, {2, 4}, {1, 4}};

double Square(double a) { return a * a; }
double At(const GridF& layer, int row, int col) { return static_cast<double>(layer.at(row, col)); }

/// What squares of one size show.
struct Figures {
  Grid<ShownBySquare> shown;
  GridF off_m, sigma_m;  ///< the same; NaN where nothing is told
};

/// Every so many places are looked at that squares overlap by half.
int StrideOf(int side) { return std::max(1, side / 2); }

int LooksOf(int places, int stride) { return (places + stride - 1) / stride; }

Figures Measure(const FineSums& sums, int side, int ring_to) {
  const int rows = sums.places().rows, cols = sums.places().cols;
  const GridF unknown(rows, cols, kUnknownValue);
  Figures figures{Grid<ShownBySquare>(rows, cols), unknown, unknown};
  const int stride = StrideOf(side);
  ForEach(LooksOf(rows, stride), [&](int look) {
    const int r = look * stride;
    for (int c = 0; c < cols; c += stride) {
      const ShownBySquare shown = OffFrame(sums, {r, c, side, ring_to});
      if (shown.told) {
        figures.shown.at(r, c) = shown;
        figures.off_m.at(r, c) = static_cast<float>(shown.off_m);
        figures.sigma_m.at(r, c) = static_cast<float>(shown.sigma_m);
      }
    }
  });
  return figures;
}

/// What a square shows in the end.
struct Asked {
  ShownBySquare shown;
  bool stands_out = false;
};

/// `stood`: it stood out on the last map; `noise_m`: besides that of what it shows.
Asked Ask(const FineSums& sums, const SquareAndFrame& at, const ShownBySquare& off_frame,
          double bumps_m, double noise_m, bool stood) {
  const double beyond = stood ? kStillStandsOut_sigmas : kStandsOut_sigmas;
  const auto stands_out = [&](const ShownBySquare& shown) {
    return shown.told &&
           std::abs(shown.off_m) > beyond * std::hypot(std::hypot(shown.sigma_m, bumps_m), noise_m);
  };
  Asked asked{off_frame};
  if (stands_out(off_frame)) {
    asked.shown = OffGroundAround(sums, at, bumps_m);
    asked.stands_out = stands_out(asked.shown) && std::abs(asked.shown.off_m) <= kTallest_m;
  }
  return asked;
}

/// Raises the ground between the cell and the camera to the rays that saw the cell at `laid_m`, as
/// far as they take to rise by `off_m`; a cell that they end in, by its part of it.
void RaiseTowardsCamera(const ElevationMap& map, Cell cell, const Eigen::Vector3d& p_WC,
                        double laid_m, double off_m, GridF& top_m) {
  const GridGeometry& g = map.geometry;
  const Eigen::Vector2d place(g.NorthOfRow(cell.row), g.EastOfCol(cell.col));
  const Eigen::Vector2d way = p_WC.head<2>() - place;
  const double distance_m = way.norm(), above_m = HeightFromDown(p_WC.z()) - laid_m;
  if (!(distance_m > g.cell_m && above_m > 0)) {
    return;  // seen from above
  }
  const double rise = above_m / distance_m, length_m = off_m / rise;
  for (double along_m = g.cell_m; along_m < length_m + g.cell_m / 2; along_m += g.cell_m) {
    const Eigen::Vector2d at = place + along_m / distance_m * way;
    const auto to = g.CellFromPoint(at.x(), at.y());
    if (!to || map.state.at(*to) != CellState::kMeasured) {
      return;
    }
    const double part = std::min(1.0, (length_m - along_m) / g.cell_m + 0.5);
    const auto ground_m = static_cast<double>(map.height_m.at(*to));
    const double ray_m = laid_m + std::min(along_m, length_m) * rise;
    if (ray_m - ground_m > kTallest_m) {
      return;  // the ground falls away: what stands on a wall does not stand before it
    }
    top_m.at(*to) =
        std::max(top_m.at(*to), static_cast<float>(ground_m + part * (ray_m - ground_m)));
  }
}

/// What stands in a cell, or is missing there.
struct NarrowThing {
  double top_m = 0;     ///< of a hole its bottom
  double height_m = 0;  ///< off its surroundings
  double off_m = 0;     ///< off the ground that its pixels were laid on
};

/// Of a rock and of a hole in one cell, what stands farther off the ground counts.
void RaiseTop(const ElevationMap& map, Cell cell, const Eigen::Vector3d& p_WC,
              const NarrowThing& thing, GridF& top_m) {
  if (!map.geometry.Contains(cell) || map.state.at(cell) != CellState::kMeasured) {
    return;
  }
  const auto to_m = static_cast<float>(thing.top_m);
  float& top = top_m.at(cell);
  if (thing.height_m < 0) {
    const float ground_m = map.height_m.at(cell);
    top = ground_m - to_m > top - ground_m ? std::min(top, to_m) : top;  // else a ray rises higher
  } else {
    top = std::max(top, to_m);
    RaiseTowardsCamera(map, cell, p_WC, thing.top_m - thing.off_m, thing.off_m, top_m);
  }
}

/// A square that stands out.
struct Standing {
  SquareAndFrame at;
  ShownBySquare shown;
  double level_m = 0;  ///< of the ground around, in W
  double times = 1;    ///< so much higher it is than it shows
};

/// Raises the top of the cells under a square that stands out.
void RaiseUnder(const Standing& square, const Eigen::Vector3d& p_WC, const ElevationMap& map,
                GridF& top_m) {
  const SquareAndFrame& at = square.at;
  NarrowThing thing;
  thing.height_m = std::clamp(square.times * square.shown.off_m, -kTallest_m, kTallest_m);
  thing.top_m = square.level_m + thing.height_m;
  thing.off_m = std::clamp(square.times * square.shown.off_laid_m, 0.0, std::abs(thing.height_m));
  const int first_row = at.row - at.side / 2, first_col = at.col - at.side / 2;
  for (int r = first_row / kPerCell; r <= (first_row + at.side - 1) / kPerCell; ++r) {
    for (int c = first_col / kPerCell; c <= (first_col + at.side - 1) / kPerCell; ++c) {
      RaiseTop(map, {r, c}, p_WC, thing, top_m);
    }
  }
}

/// A map as squares of one size look at it.
struct Look {
  const FineSums& sums;
  const Viewpoint& view;
  const GridF& repeated_m2;
  std::size_t scale;  ///< of kScales
  Figures figures;
  GroundBumps bumps;

  int side() const { return kScales[scale].sides * sums.side(); }
  bool IsNarrowest() const { return kScales[scale].sides == 1; }
};

Look LookAt(const FineSums& sums, const Viewpoint& view, const GridF& repeated_m2,
            std::size_t scale) {
  const int side = kScales[scale].sides * sums.side();
  Figures figures = Measure(sums, side, kScales[scale].ring_to);
  GroundBumps bumps(figures.off_m, figures.sigma_m, sums.places().cell_m, side);
  return {sums, view, repeated_m2, scale, std::move(figures), std::move(bumps)};
}

/// What stands out in a row of places. Remembers in `standing` that it does, a bit a scale; the
/// narrowest squares give `narrow` its figures.
std::vector<Standing> LookAlong(const Look& look, int r, Grid<std::uint8_t>& standing,
                                NarrowFigures& narrow) {
  const GridGeometry& places = look.sums.places();
  const double square_m = look.sums.side() * places.cell_m;
  const Scale& scale = kScales[look.scale];
  const unsigned bit = 1U << look.scale;
  std::vector<Standing> found;
  for (int c = 0; c < places.cols; c += StrideOf(look.side())) {
    std::uint8_t& stood = standing.at(r, c);
    const bool stood_out = (stood & bit) != 0;
    stood = static_cast<std::uint8_t>(stood & ~bit);
    const ShownBySquare& off_frame = look.figures.shown.at(r, c);
    if (!off_frame.told) {
      continue;
    }
    const SquareAndFrame at{r, c, look.side(), scale.ring_to};
    const double bumps_m = look.bumps.At(r, c);
    const double repeated_m = std::sqrt(At(look.repeated_m2, r / kPerCell, c / kPerCell));
    const double worst_m = look.IsNarrowest() ? 0 : kWorstTexture * repeated_m;
    const auto [shown, stands_out] = Ask(look.sums, at, off_frame, bumps_m, worst_m, stood_out);
    stood = static_cast<std::uint8_t>(stood | (stands_out ? bit : 0U));
    if (!(shown.told && std::abs(shown.off_m) <= kTallest_m)) {
      continue;
    }
    const double level_m = shown.level_m + look.sums.reference_m();
    const Eigen::Vector3d p_WQ(places.NorthOfRow(r), places.EastOfCol(c), -level_m);
    const double gradient_m = kGradient_px * look.view.Pixel_m(p_WQ);
    const double smear = (Square(gradient_m) + Square(square_m)) / Square(kThing_m);
    if (look.IsNarrowest()) {
      const double noise_m = std::hypot(shown.sigma_m, repeated_m);
      narrow.prominence_m.at(r, c) = static_cast<float>(shown.off_m);
      narrow.noise_m.at(r, c) = static_cast<float>(noise_m);
      narrow.sigma_m.at(r, c) = static_cast<float>(std::hypot(noise_m, bumps_m));
      narrow.share.at(r, c) = static_cast<float>(kPeakOfThing / (1 + smear));
    }
    if (stands_out) {
      // What fills a wider square shows all of its height.
      found.push_back({at, shown, level_m, std::max(1.0, (1 + smear) / scale.sides)});
    }
  }
  return found;
}

}  // namespace

void TakeNarrowThings(const FineSums& sums, const Viewpoint& view, const GridF& repeated_m2,
                      Grid<std::uint8_t>& standing, ElevationMap& map) {
  const GridGeometry& places = sums.places();
  PALACE_CHECK(standing.rows() == places.rows && standing.cols() == places.cols, standing.rows(),
               places.rows);
  const GridF unknown(places.rows, places.cols, kUnknownValue);
  map.narrow = {unknown, unknown, unknown, unknown, 0};
  GridF top_m = map.height_m;
  for (std::size_t k = 0; k < std::size(kScales); ++k) {
    const Look look = LookAt(sums, view, repeated_m2, k);
    if (look.IsNarrowest()) {
      map.narrow.ring_m = (0.5 + kScales[k].ring_to) * (sums.side() * places.cell_m);
    }
    const int stride = StrideOf(look.side());
    std::vector<std::vector<Standing>> found(
        static_cast<std::size_t>(LooksOf(places.rows, stride)));
    ForEach(static_cast<int>(found.size()), [&](int i) {
      found[static_cast<std::size_t>(i)] = LookAlong(look, i * stride, standing, map.narrow);
    });
    for (const std::vector<Standing>& row : found) {
      for (const Standing& square : row) {
        RaiseUnder(square, view.p_WC, map, top_m);
      }
    }
  }
  map.height_m = std::move(top_m);
}

}  // namespace palace
