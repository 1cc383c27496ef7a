#include "engine/slad/terrain/narrow_things.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/core.hpp>

#include "engine/core/frames.h"
#include "engine/slad/terrain/ground_bumps.h"

namespace palace {
namespace {

constexpr int kPerCell = NarrowFigures::kPerCell;
/// Width of the thing that must not hide: half as wide again as it is high, at 1.2 times the
/// default limit; and the share of its height that it shows unsmeared.
constexpr double kThing_m = 0.18, kPeakOfThing = 0.8;
constexpr double kWorstTexture = 2.5;  // times the error that stereo's window usually repeats
constexpr double kGradient_px = 3;     // width that a five-point derivative feels
constexpr double kTallest_m = 1;
constexpr int kRingFrom = 1;  // of the frame around, in squares beyond the square
/// Squares that are looked at, the narrowest last: times the side, and how far their frame reaches.
struct Scale {
  int sides, ring_to;
};
constexpr Scale kScales[] = {{4, 2}, {2, 4}, {1, 4}};

double Square(double a) { return a * a; }
double At(const GridF& layer, int row, int col) { return static_cast<double>(layer.at(row, col)); }

/// What places show; NaN where nothing can be said.
struct Figures {
  GridF prominence_m;  ///< p
  GridF sigma_m;       ///< sigma_p
  GridF level_m;       ///< of the plane
  GridF off_laid_m;    ///< of the height, off the ground that the square's pixels were laid on
  int side = 1;        ///< of the square, places
};

/// Every so many places are looked at that squares overlap by half.
int StrideOf(int side) { return std::max(1, side / 2); }

Figures Measure(const FineSums& sums, int side, int ring_to) {
  const GridGeometry& places = sums.places();
  const GridF unknown(places.rows, places.cols, kUnknownValue);
  Figures shown{unknown, unknown, unknown, unknown, side};
  cv::parallel_for_(cv::Range(0, places.rows), [&](const cv::Range& rows) {
    const int stride = StrideOf(side);
    for (int r = (rows.start + stride - 1) / stride * stride; r < rows.end; r += stride) {
      for (int c = 0; c < places.cols; c += stride) {
        const FineSum own = sums.Over(r, c, side);
        if (!own.known()) {
          continue;
        }
        const FinePlane around = PlaneThrough(sums.Over(r, c, side, ring_to * side) -
                                              sums.Over(r, c, side, kRingFrom * side));
        const double aside = around.told ? around.Aside(own.x(), own.y()) : HUGE_VAL;
        if (aside <= kMostAside) {
          const double level_m = around.At(own.x(), own.y());
          shown.prominence_m.at(r, c) = static_cast<float>(own.height_m() - level_m);
          shown.level_m.at(r, c) = static_cast<float>(level_m + sums.reference_m());
          shown.off_laid_m.at(r, c) = static_cast<float>(own.off_laid_m());
          shown.sigma_m.at(r, c) =
              static_cast<float>(std::sqrt(own.variance_m2() + (1 + aside) * around.variance_m2));
        }
      }
    }
  });
  return shown;
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

/// Raises the top of the cells under the square about a place that stands out by kStandsOut_sigmas,
/// to `times` as much as it shows.
void RaiseUnder(const Figures& fine, int row, int col, double times, double sigma_m,
                const Eigen::Vector3d& p_WC, const ElevationMap& map, GridF& top_m) {
  const double shown_m = At(fine.prominence_m, row, col);
  if (!(std::abs(shown_m) <= kTallest_m && std::abs(shown_m) > kStandsOut_sigmas * sigma_m)) {
    return;
  }
  NarrowThing thing;
  thing.height_m = std::clamp(times * shown_m, -kTallest_m, kTallest_m);
  thing.top_m = At(fine.level_m, row, col) + thing.height_m;
  thing.off_m = std::clamp(times * At(fine.off_laid_m, row, col), 0.0, std::abs(thing.height_m));
  const int first_row = row - fine.side / 2, first_col = col - fine.side / 2;
  for (int r = first_row / kPerCell; r <= (first_row + fine.side - 1) / kPerCell; ++r) {
    for (int c = first_col / kPerCell; c <= (first_col + fine.side - 1) / kPerCell; ++c) {
      RaiseTop(map, {r, c}, p_WC, thing, top_m);
    }
  }
}

}  // namespace

void TakeNarrowThings(const FineSums& sums, const Viewpoint& view, const GridF& repeated_m2,
                      ElevationMap& map) {
  const GridGeometry& places = sums.places();
  const double square_m = sums.side() * places.cell_m;
  const GridF unknown(places.rows, places.cols, kUnknownValue);
  map.narrow = {unknown, unknown, unknown, unknown, 0};
  GridF top_m = map.height_m;
  for (const Scale& scale : kScales) {
    const Figures figures = Measure(sums, scale.sides * sums.side(), scale.ring_to);
    const GroundBumps bumps(figures.prominence_m, figures.sigma_m, places.cell_m, figures.side);
    const bool narrowest = scale.sides == 1;
    if (narrowest) {
      map.narrow.ring_m = (0.5 + scale.ring_to) * square_m;
    }
    const int stride = StrideOf(figures.side);
    for (int r = 0; r < places.rows; r += stride) {
      for (int c = 0; c < places.cols; c += stride) {
        const double shown_m = At(figures.prominence_m, r, c);
        if (!(std::abs(shown_m) <= kTallest_m)) {
          continue;
        }
        const double noise_m = At(figures.sigma_m, r, c);
        const double sigma_m = std::hypot(noise_m, bumps.At(r, c));
        const Eigen::Vector3d p_WQ(places.NorthOfRow(r), places.EastOfCol(c),
                                   -At(figures.level_m, r, c));
        const double gradient_m = kGradient_px * view.Pixel_m(p_WQ);
        const double repeated_m = std::sqrt(At(repeated_m2, r / kPerCell, c / kPerCell));
        const double smear = (Square(gradient_m) + Square(square_m)) / Square(kThing_m);
        if (narrowest) {
          map.narrow.prominence_m.at(r, c) = static_cast<float>(shown_m);
          map.narrow.noise_m.at(r, c) = static_cast<float>(std::hypot(noise_m, repeated_m));
          map.narrow.sigma_m.at(r, c) = static_cast<float>(std::hypot(sigma_m, repeated_m));
          map.narrow.share.at(r, c) = static_cast<float>(kPeakOfThing / (1 + smear));
        }
        // What fills a wider square shows all of its height.
        const double times = std::max(1.0, (1 + smear) / scale.sides);
        const double worst_m = narrowest ? 0 : kWorstTexture * repeated_m;
        RaiseUnder(figures, r, c, times, std::hypot(sigma_m, worst_m), view.p_WC, map, top_m);
      }
    }
  }
  map.height_m = std::move(top_m);
}

}  // namespace palace
