#include "engine/slad/narrow_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace palace {
namespace {

constexpr int kPlaces = 16;
constexpr int kLeastPlaces = 10;
constexpr double kSigmas = 5.5;
constexpr double kBesideSigmas = 4;
constexpr double kClearSigmas = 8, kBesideClearSigmas = 2.5;
constexpr double kLeastVariance_m2 = 1e-12;  // of maps that state none
constexpr double kRoughs = 3.5;
constexpr double kMostFactor = 6;
constexpr double kSteepFactor = 4;
constexpr double kTallest_m = 1;
constexpr double kMostRefused = 0.15;  // share of a cell's pixels

/// The ground around a cell: the plane through its ring.
struct Ring {
  double mean_m = 0;  ///< at the cell
  double per_row_m = 0, per_col_m = 0;
  double variance_m2 = 0;  ///< of the mean, neighbours taken as independent
  double rough_m2 = 0;     ///< mean square off the plane
  int places = 0;
};

struct Place {
  double south = 0, east = 0;
};
using HalfCircle = std::array<Place, kPlaces / 2>;

HalfCircle Directions() {
  HalfCircle directions;
  for (int k = 0; k < kPlaces / 2; ++k) {
    const double azimuth = 2 * std::numbers::pi * k / kPlaces;
    directions[static_cast<std::size_t>(k)] = {std::cos(azimuth), std::sin(azimuth)};
  }
  return directions;
}

bool IsMeasured(const ElevationMap& map, Cell cell) {
  return map.geometry.Contains(cell) && map.state.at(cell) == CellState::kMeasured;
}

/// Places count in pairs that face each other, so that a slope's mean is the cell's own height
/// where part of the ring is unknown. Without a plane: no place.
Ring RingAround(const ElevationMap& map, const HalfCircle& directions, Cell cell,
                double radius_cells) {
  const double own_m = static_cast<double>(map.height_m.at(cell));
  Ring ring;
  double sum = 0, square = 0;
  double rr = 0, rc = 0, cc = 0, rz = 0, cz = 0;  // sums of products: row, column, height
  for (const auto& [south, east] : directions) {
    const int dr = static_cast<int>(std::lround(radius_cells * south));
    const int dc = static_cast<int>(std::lround(radius_cells * east));
    const Cell ahead{cell.row + dr, cell.col + dc}, behind{cell.row - dr, cell.col - dc};
    if (!IsMeasured(map, ahead) || !IsMeasured(map, behind)) {
      continue;
    }
    const double a = static_cast<double>(map.height_m.at(ahead)) - own_m;
    const double b = static_cast<double>(map.height_m.at(behind)) - own_m;
    sum += a + b;
    square += a * a + b * b;
    rr += 2.0 * dr * dr;
    rc += 2.0 * dr * dc;
    cc += 2.0 * dc * dc;
    rz += dr * (a - b);
    cz += dc * (a - b);
    ring.variance_m2 += static_cast<double>(map.variance_m2.at(ahead)) +
                        static_cast<double>(map.variance_m2.at(behind));
    ring.places += 2;
  }
  const double determinant = rr * cc - rc * rc;
  if (!(determinant > 0)) {
    return {};
  }
  const double n = ring.places, mean = sum / n;
  ring.per_row_m = (cc * rz - rc * cz) / determinant;
  ring.per_col_m = (rr * cz - rc * rz) / determinant;
  ring.rough_m2 =
      std::max(0.0, (square - ring.per_row_m * rz - ring.per_col_m * cz) / n - mean * mean);
  ring.mean_m = mean + own_m;
  ring.variance_m2 /= n * n;
  return ring;
}

/// Height above the ring's plane in sigmas, of the cell `dr` and `dc` beside the ring's own.
double SigmasAbove(const ElevationMap& map, const Ring& ring, Cell cell, int dr, int dc) {
  const Cell at{cell.row + dr, cell.col + dc};
  const double stands_m = static_cast<double>(map.height_m.at(at)) - ring.mean_m -
                          ring.per_row_m * dr - ring.per_col_m * dc;
  return stands_m / std::sqrt(static_cast<double>(map.variance_m2.at(at)) + ring.variance_m2 +
                              kLeastVariance_m2);
}

/// The same of the highest of the four cells beside; 0 where none is known. Noise seldom stands
/// twice; a thing as wide as the window lies in more than one cell.
double SigmasBeside(const ElevationMap& map, const Ring& ring, Cell cell) {
  double most = 0;
  for (const auto& [dr, dc] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    if (IsMeasured(map, {cell.row + dr, cell.col + dc})) {
      most = std::max(most, SigmasAbove(map, ring, cell, dr, dc));
    }
  }
  return most;
}

bool ManyRefused(const Grid<PixelCount>& pixels, const GridGeometry& geometry, int row, int col) {
  for (int r = row - 1; !pixels.empty() && r <= row + 1; ++r) {
    for (int c = col - 1; c <= col + 1; ++c) {
      if (geometry.Contains({r, c}) && pixels.at(r, c).RefusedShare() > kMostRefused) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

void RaiseNarrowRelief(const PinholeCamera& camera, const Eigen::Vector3d& p_WC, double narrow_m,
                       const Grid<PixelCount>& pixels, ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  const HalfCircle directions = Directions();
  const GridF before = map.height_m;
  GridF raised = before;
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      if (map.state.at(r, c) != CellState::kMeasured) {
        continue;
      }
      const double height_m = static_cast<double>(before.at(r, c));
      const Eigen::Vector3d p_WQ(g.NorthOfRow(r), g.EastOfCol(c), -height_m);
      const double window_m = kStereoWindow_px * (p_WQ - p_WC).norm() / camera.fx_px;
      const double widths = window_m / narrow_m;
      const double factor = std::clamp(
          widths * widths, ManyRefused(pixels, g, r, c) ? kSteepFactor : 1.0, kMostFactor);
      if (factor <= 1) {
        continue;
      }
      const Ring ring = RingAround(map, directions, {r, c},
                                   std::max(2.0, (0.75 * window_m + narrow_m / 2) / g.cell_m));
      const double stands_m = height_m - ring.mean_m;
      if (ring.places < kLeastPlaces || stands_m * stands_m <= kRoughs * kRoughs * ring.rough_m2) {
        continue;
      }
      const double sigmas = SigmasAbove(map, ring, {r, c}, 0, 0);
      const double beside = sigmas > kClearSigmas ? kBesideClearSigmas : kBesideSigmas;
      if (sigmas <= kSigmas || SigmasBeside(map, ring, {r, c}) <= beside) {
        continue;
      }
      const double must_be_m = std::max(stands_m, std::min(factor * stands_m, kTallest_m));
      raised.at(r, c) = static_cast<float>(height_m + must_be_m - stands_m);
    }
  }
  map.height_m = std::move(raised);
}

}  // namespace palace
