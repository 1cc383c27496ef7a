#include "engine/slad/narrow_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palace {
namespace {

constexpr int kPlaces = 16;
constexpr int kLeastPlaces = 10;
constexpr double kSigmas = 6;
constexpr double kMostFactor = 6;
constexpr double kSteepFactor = 4;
constexpr double kTallest_m = 1;
constexpr double kMostRefused = 0.15;  // share of a cell's pixels

struct Ring {
  double mean_m = 0;
  double variance_m2 = 0;  ///< of the mean, neighbours taken as independent
  int known = 0;
};

Ring RingAround(const ElevationMap& map, int row, int col, double radius_cells) {
  Ring ring;
  for (int k = 0; k < kPlaces; ++k) {
    const double azimuth = 2 * std::numbers::pi * k / kPlaces;
    const Cell at{row + static_cast<int>(std::lround(radius_cells * std::cos(azimuth))),
                  col + static_cast<int>(std::lround(radius_cells * std::sin(azimuth)))};
    if (map.geometry.Contains(at) && map.state.at(at) == CellState::kMeasured) {
      ring.mean_m += static_cast<double>(map.height_m.at(at));
      ring.variance_m2 += static_cast<double>(map.variance_m2.at(at));
      ++ring.known;
    }
  }
  if (ring.known > 0) {
    ring.mean_m /= ring.known;
    ring.variance_m2 /= static_cast<double>(ring.known) * ring.known;
  }
  return ring;
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
      const Ring ring =
          RingAround(map, r, c, std::max(2.0, (0.75 * window_m + narrow_m / 2) / g.cell_m));
      const double stands_m = height_m - ring.mean_m;
      const double noise_m2 = static_cast<double>(map.variance_m2.at(r, c)) + ring.variance_m2;
      if (ring.known < kLeastPlaces || stands_m <= 0 ||
          stands_m * stands_m <= kSigmas * kSigmas * noise_m2) {
        continue;
      }
      const double must_be_m = std::max(stands_m, std::min(factor * stands_m, kTallest_m));
      raised.at(r, c) = static_cast<float>(height_m + must_be_m - stands_m);
    }
  }
  map.height_m = std::move(raised);
}

}  // namespace palace
