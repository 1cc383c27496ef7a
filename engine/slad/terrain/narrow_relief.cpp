#include "engine/slad/terrain/narrow_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <opencv2/core.hpp>

#include "engine/core/check.h"
#include "engine/slad/terrain/ground_roughness.h"

namespace palace {
namespace {

constexpr int kPlaces = 16;
constexpr int kLeastPlaces = 10;
constexpr double kSigmas = 5.5;
constexpr double kBesideSigmas = 4;
constexpr double kClearSigmas = 8, kBesideClearSigmas = 2.5;
constexpr double kLeastVariance_m2 = 1e-12;  // of maps that state none
constexpr double kRingRoughs = 3.5, kGroundRoughs = 4;
constexpr double kClearRingRoughs = 10;  // of many things on even ground
constexpr double kRepeats = 2.5;         // what stereo repeats at worst, over its usual sigma
constexpr double kLeastRing_cells = 2;
constexpr double kMostFactor = 6;
constexpr double kSteepFactor = 4;
constexpr double kTallest_m = 1;
constexpr double kMostRefused = 0.15;  // share of a cell's pixels

/// The ground around a cell: the plane through its ring.
struct Ring {
  double own_m = 0;   ///< the cell
  double mean_m = 0;  ///< at the cell
  double per_row_m = 0, per_col_m = 0;
  double variance_m2 = 0;  ///< of the mean, neighbours taken as independent
  double rough_m2 = 0;     ///< mean square off the plane
  int places = 0;
  std::array<double, kPlaces / 2> pairs_m{};  ///< means of places that face each other, off own_m

  /// At the cell, whatever fewer than half of the pairs say.
  double Median_m() const {
    std::array<double, kPlaces / 2> sorted = pairs_m;
    const auto count = static_cast<std::size_t>(places / 2);
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
    return own_m + (sorted[(count - 1) / 2] + sorted[count / 2]) / 2;
  }
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
Ring RingAround(const ElevationMap& map, const GridF& heights_m, const HalfCircle& directions,
                Cell cell, double radius_cells) {
  const double own_m = static_cast<double>(heights_m.at(cell));
  Ring ring;
  ring.own_m = own_m;
  double sum = 0, square = 0;
  double rr = 0, rc = 0, cc = 0, rz = 0, cz = 0;  // sums of products: row, column, height
  for (const auto& [south, east] : directions) {
    const int dr = static_cast<int>(std::lround(radius_cells * south));
    const int dc = static_cast<int>(std::lround(radius_cells * east));
    const Cell ahead{cell.row + dr, cell.col + dc}, behind{cell.row - dr, cell.col - dc};
    if (!IsMeasured(map, ahead) || !IsMeasured(map, behind)) {
      continue;
    }
    const double a = static_cast<double>(heights_m.at(ahead)) - own_m;
    const double b = static_cast<double>(heights_m.at(behind)) - own_m;
    sum += a + b;
    ring.pairs_m[static_cast<std::size_t>(ring.places / 2)] = (a + b) / 2;
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
double SigmasProminent(const ElevationMap& map, const Ring& ring, Cell cell, int dr, int dc) {
  const Cell at{cell.row + dr, cell.col + dc};
  const double prominence_m = static_cast<double>(map.height_m.at(at)) - ring.mean_m -
                              ring.per_row_m * dr - ring.per_col_m * dc;
  return prominence_m / std::sqrt(static_cast<double>(map.variance_m2.at(at)) + ring.variance_m2 +
                                  kLeastVariance_m2);
}

/// The same, times `side`, of the one of the four cells beside that is farthest on that side; 0
/// where none is known. Noise seldom stands twice; a thing as wide as the window lies in more than
/// one cell.
double SigmasBeside(const ElevationMap& map, const Ring& ring, Cell cell, double side) {
  double most = 0;
  for (const auto& [dr, dc] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    if (IsMeasured(map, {cell.row + dr, cell.col + dc})) {
      most = std::max(most, side * SigmasProminent(map, ring, cell, dr, dc));
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

/// Stereo's matching window on a map and the rings that fit it.
class MatchingWindow {
 public:
  MatchingWindow(const PinholeCamera& camera, const Eigen::Vector3d& p_WC, double narrow_m)
      : p_WC_(p_WC), per_m_(kStereoWindow_px / camera.fx_px), narrow_m_(narrow_m) {}

  double Width_m(const ElevationMap& map, Cell cell) const {
    const Eigen::Vector3d p_WQ(map.geometry.NorthOfRow(cell.row), map.geometry.EastOfCol(cell.col),
                               -static_cast<double>(map.height_m.at(cell)));
    return per_m_ * (p_WQ - p_WC_).norm();
  }

  Ring RingAt(const ElevationMap& map, const GridF& heights_m, Cell cell) const {
    const double radius_m = kRingWindows * Width_m(map, cell) + narrow_m_ / 2;
    return RingAround(map, heights_m, directions_, cell,
                      std::max(kLeastRing_cells, radius_m / map.geometry.cell_m));
  }

 private:
  Eigen::Vector3d p_WC_;
  double per_m_, narrow_m_;
  HalfCircle directions_ = Directions();
};

/// What measured cells stand above their rings by, m; NaN without a ring.
struct Prominences {
  GridF height_m;
  GridF sigma_m;  ///< of it, without what stereo repeats
};

Prominences ProminencesOf(const ElevationMap& map, const GridF& heights_m,
                          const MatchingWindow& window, double (*level_m)(const Ring&)) {
  const GridF unknown(map.geometry.rows, map.geometry.cols, kUnknownValue);
  Prominences prominence{unknown, unknown};
  cv::parallel_for_(cv::Range(0, unknown.rows()), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      for (int c = 0; c < unknown.cols(); ++c) {
        if (!IsMeasured(map, {r, c})) {
          continue;
        }
        const Ring ring = window.RingAt(map, heights_m, {r, c});
        if (ring.places >= kLeastPlaces) {
          prominence.height_m.at(r, c) =
              static_cast<float>(static_cast<double>(heights_m.at(r, c)) - level_m(ring));
          prominence.sigma_m.at(r, c) = static_cast<float>(
              std::sqrt(static_cast<double>(map.variance_m2.at(r, c)) + ring.variance_m2));
        }
      }
    }
  });
  return prominence;
}

/// What a thing kThing_m wide would show against what the measured ground shows.
NarrowFigures FiguresOf(const ElevationMap& map, const MatchingWindow& window,
                        const GridF& repeated_m2) {
  const GridGeometry& g = map.geometry;
  const GridF unknown(g.rows, g.cols, kUnknownValue);
  Prominences prominence =
      ProminencesOf(map, map.Measured(), window, [](const Ring& ring) { return ring.Median_m(); });
  // No thing that narrow stands so far off its ring: a wide edge does, or a false match.
  for (float& off_m : prominence.height_m.cells()) {
    off_m = std::abs(off_m) > static_cast<float>(kTallest_m) ? kUnknownValue : off_m;
  }
  const GroundRoughness roughness(prominence.height_m, g.cell_m);
  NarrowFigures figures{std::move(prominence.height_m), std::move(prominence.sigma_m), unknown};
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      float& sigma_m = figures.sigma_m.at(r, c);
      if (std::isnan(figures.prominence_m.at(r, c))) {
        sigma_m = kUnknownValue;
        continue;
      }
      const float repeated = repeated_m2.empty() ? 0.0F : repeated_m2.at(r, c);
      // Among bumps a bump says nothing: what cells around stand off their rings by is noise too.
      sigma_m =
          std::max(std::sqrt(sigma_m * sigma_m + repeated), static_cast<float>(roughness.At(r, c)));
      const double spread_m2 = std::pow(window.Width_m(map, {r, c}), 2) + g.cell_m * g.cell_m;
      figures.share.at(r, c) = static_cast<float>(ShareOfSmeared(spread_m2));
    }
  }
  return figures;
}

/// Whether the window is wider than a narrow thing anywhere.
bool SmearsAnywhere(const ElevationMap& map, const MatchingWindow& window, double narrow_m) {
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      if (IsMeasured(map, {r, c}) && window.Width_m(map, {r, c}) > narrow_m) {
        return true;
      }
    }
  }
  return false;
}

/// Whether a cell that stands `prominence_m` above its ring, or below where that is negative, is a
/// thing or a hole on its own: not noise, not rough ground, not the edge of something wide.
bool IsProminent(const ElevationMap& map, const Ring& ring, Cell cell, double prominence_m,
                 double ground_rough_m, double repeated_m2) {
  const double noise_m2 = static_cast<double>(map.variance_m2.at(cell)) + ring.variance_m2 +
                          kRepeats * kRepeats * repeated_m2;
  const double ground_m2 = std::max(0.0, ground_rough_m * ground_rough_m - noise_m2);
  const double needed_m2 = std::clamp(kGroundRoughs * kGroundRoughs * ground_m2,
                                      kRingRoughs * kRingRoughs * ring.rough_m2,
                                      kClearRingRoughs * kClearRingRoughs * ring.rough_m2);
  if (prominence_m * prominence_m <= needed_m2) {
    return false;
  }
  const double side = prominence_m < 0 ? -1 : 1;
  const double sigmas = side * SigmasProminent(map, ring, cell, 0, 0);
  const double beside = sigmas > kClearSigmas ? kBesideClearSigmas : kBesideSigmas;
  return sigmas > kSigmas && SigmasBeside(map, ring, cell, side) > beside;
}

/// Raises the ground between the cell and the camera to the rays that saw the cell, as far as they
/// take to rise by `missing_m`; a cell that they end in, by its part of it.
void RaiseTowardsCamera(const ElevationMap& map, Cell cell, const Eigen::Vector3d& p_WC,
                        double missing_m, GridF& raised) {
  const GridGeometry& g = map.geometry;
  const double own_m = static_cast<double>(map.height_m.at(cell));
  const Eigen::Vector2d place(g.NorthOfRow(cell.row), g.EastOfCol(cell.col));
  const Eigen::Vector2d way = p_WC.head<2>() - place;
  const double distance_m = way.norm(), above_m = HeightFromDown(p_WC.z()) - own_m;
  if (!(distance_m > g.cell_m && above_m > 0)) {
    return;  // seen from above: what is read as too low stands where it is read
  }
  const double rise = above_m / distance_m, length_m = missing_m / rise;
  for (double along_m = g.cell_m; along_m < length_m + g.cell_m / 2; along_m += g.cell_m) {
    const Eigen::Vector2d at = place + along_m / distance_m * way;
    const auto to = g.CellFromPoint(at.x(), at.y());
    if (!to || !IsMeasured(map, *to)) {
      return;
    }
    const double part = std::min(1.0, (length_m - along_m) / g.cell_m + 0.5);
    const double ground_m = static_cast<double>(map.height_m.at(*to));
    const double ray_m = own_m + std::min(along_m, length_m) * rise;
    raised.at(*to) =
        std::max(raised.at(*to), static_cast<float>(ground_m + part * (ray_m - ground_m)));
  }
}

}  // namespace

NarrowFigures MeasureNarrowRelief(const PinholeCamera& camera, const Eigen::Vector3d& p_WC,
                                  double narrow_m, const GridF& repeated_m2,
                                  const ElevationMap& map) {
  return FiguresOf(map, MatchingWindow(camera, p_WC, narrow_m), repeated_m2);
}

void RaiseNarrowRelief(const PinholeCamera& camera, const Eigen::Vector3d& p_WC, double narrow_m,
                       const Grid<PixelCount>& pixels, const GridF& repeated_m2,
                       ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  PALACE_CHECK(pixels.empty() || (pixels.rows() == g.rows && pixels.cols() == g.cols));
  PALACE_CHECK(repeated_m2.empty() ||
               (repeated_m2.rows() == g.rows && repeated_m2.cols() == g.cols));
  const MatchingWindow window(camera, p_WC, narrow_m);
  if (pixels.empty() && !SmearsAnywhere(map, window, narrow_m)) {
    return;
  }
  const GridF prominence = ProminencesOf(map, map.height_m, window, [](const Ring& ring) {
                             return ring.mean_m;
                           }).height_m;
  const GroundRoughness roughness(prominence, g.cell_m);
  GridF raised = map.height_m;
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      const double prominence_m = static_cast<double>(prominence.at(r, c));
      const double sigma_m = std::sqrt(static_cast<double>(map.variance_m2.at(r, c)));
      const double off_m = std::abs(prominence_m);
      if (!(off_m > kSigmas * sigma_m)) {
        continue;
      }
      const double widths = window.Width_m(map, {r, c}) / narrow_m;
      const double factor = std::clamp(
          widths * widths, ManyRefused(pixels, g, r, c) ? kSteepFactor : 1.0, kMostFactor);
      const double repeated = repeated_m2.empty() ? 0.0 : static_cast<double>(repeated_m2.at(r, c));
      if (factor > 1 && IsProminent(map, window.RingAt(map, map.height_m, {r, c}), {r, c},
                                    prominence_m, roughness.At(r, c), repeated)) {
        const double missing_m = std::max(0.0, std::min(factor * off_m, kTallest_m) - off_m);
        const auto own_m = static_cast<double>(map.height_m.at(r, c));
        if (prominence_m < 0) {
          raised.at(r, c) = static_cast<float>(own_m - missing_m);
        } else {
          raised.at(r, c) = std::max(raised.at(r, c), static_cast<float>(own_m + missing_m));
          if (off_m > kClearSigmas * sigma_m) {
            RaiseTowardsCamera(map, {r, c}, p_WC, missing_m, raised);
          }
        }
      }
    }
  }
  map.height_m = std::move(raised);
}

}  // namespace palace
