#include "engine/slad/terrain/fine_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/slad/terrain/ground_bumps.h"

namespace palace {
namespace {

constexpr std::array kSquares = {1, 2, 4};  // of the details, in squares
constexpr int kPlaneSquares = 8;
constexpr double kBump_sigmas = 3;  // up to there a detail is a bump of that ground
constexpr double kDenied_m = 0.02;

double Square(double a) { return a * a; }

/// Details of one size, and their noise (sigma); NaN where nothing is told.
struct Details {
  GridF off_m, sigma_m;
};

/// What the pictures tell of a map's ground: the plane about each cell and the details on it, from
/// fine to coarse; NaN where nothing is told.
struct TellsOfGround {
  GridF plane_m, plane_variance_m2;
  std::vector<Details> details;
};

/// Of one cell; `plane` is told there.
void TellDetails(const FineSums& sums, Cell cell, Cell corner, const FinePlane& plane,
                 std::vector<Details>& details) {
  double coarser_m = 0, coarser_m2 = 0;
  for (std::size_t k = kSquares.size(); k-- > 0;) {
    const FineSum own = sums.Over(corner.row, corner.col, kSquares[k] * sums.side());
    if (!own.known()) {
      break;
    }
    const double off_m = own.height_m() - plane.At(own.x(), own.y());
    const double noise_m2 = own.variance_m2();
    details[k].off_m.at(cell) = static_cast<float>(off_m - coarser_m);
    // Squares are nested: what is new in the smaller one.
    details[k].sigma_m.at(cell) =
        static_cast<float>(std::sqrt(std::max(noise_m2 - coarser_m2, noise_m2 / 4)));
    coarser_m = off_m;
    coarser_m2 = noise_m2;
  }
}

TellsOfGround GroundToldBy(const FineSums& sums, const ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  const GridGeometry& places = sums.places();
  constexpr int kPerCell = NarrowFigures::kPerCell;
  const GridF unknown(g.rows, g.cols, kUnknownValue);
  TellsOfGround tells{unknown, unknown,
                      std::vector<Details>(kSquares.size(), Details{unknown, unknown})};
  cv::parallel_for_(cv::Range(0, g.rows), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      for (int c = 0; c < g.cols; ++c) {
        if (map.state.at(r, c) != CellState::kMeasured) {
          continue;
        }
        const Cell corner{kPerCell * r + 1, kPerCell * c + 1};  // in its middle
        const FinePlane plane =
            PlaneThrough(sums.Over(corner.row, corner.col, kPlaneSquares * sums.side()));
        const double x = corner.col - 0.5 - places.cols / 2.0,
                     y = corner.row - 0.5 - places.rows / 2.0;
        if (!plane.told || !(plane.Aside(x, y) <= kMostAside)) {
          continue;
        }
        tells.plane_m.at(r, c) = static_cast<float>(plane.At(x, y) + sums.reference_m());
        tells.plane_variance_m2.at(r, c) =
            static_cast<float>((1 + plane.Aside(x, y)) * plane.variance_m2);
        TellDetails(sums, {r, c}, corner, plane, tells.details);
      }
    }
  });
  return tells;
}

struct Height {
  double height_m = 0, variance_m2 = 0;
};

/// The plane's, with each detail as far as it is rather a bump than noise.
Height HeightOf(const TellsOfGround& tells, const std::vector<GroundBumps>& bumps, Cell cell) {
  Height told{static_cast<double>(tells.plane_m.at(cell)),
              static_cast<double>(tells.plane_variance_m2.at(cell))};
  for (std::size_t k = 0; k < tells.details.size(); ++k) {
    const double bumps_m2 = Square(bumps[k].At(cell.row, cell.col));
    const auto off_m = static_cast<double>(tells.details[k].off_m.at(cell));
    if (std::isnan(off_m)) {
      told.variance_m2 += bumps_m2;  // nothing is told of the bump
      continue;
    }
    const double noise_m2 = Square(static_cast<double>(tells.details[k].sigma_m.at(cell)));
    const double sigmas = std::abs(off_m) / std::sqrt(bumps_m2 + noise_m2);
    const double no_bump =
        std::clamp((sigmas - kBump_sigmas) / (kStandsOut_sigmas - kBump_sigmas), 0.0, 1.0);
    const double weight = std::max(bumps_m2 / (bumps_m2 + noise_m2), no_bump);
    told.height_m += weight * off_m;
    told.variance_m2 += weight * noise_m2;
  }
  return told;
}

/// In place of what stereo measured, where it is better known and stereo does not deny it.
void Take(const Height& told, Cell cell, ElevationMap& map) {
  float& measured_m = map.measured_m.at(cell);
  float& own_m2 = map.variance_m2.at(cell);
  const double off_m = told.height_m - static_cast<double>(measured_m);
  const auto stereo_m2 = static_cast<double>(own_m2);
  if (told.variance_m2 >= stereo_m2 ||
      std::abs(off_m) > kStandsOut_sigmas * std::sqrt(stereo_m2 + told.variance_m2) + kDenied_m) {
    return;
  }
  map.height_m.at(cell) += static_cast<float>(off_m);
  measured_m = static_cast<float>(told.height_m);
  own_m2 = static_cast<float>(told.variance_m2);
}

}  // namespace

void TakeFineGround(const FineSums& sums, ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  const TellsOfGround tells = GroundToldBy(sums, map);
  std::vector<GroundBumps> bumps;
  for (std::size_t k = 0; k < tells.details.size(); ++k) {
    const int width = std::max(1, kSquares[k] * sums.side() / NarrowFigures::kPerCell);
    bumps.emplace_back(tells.details[k].off_m, tells.details[k].sigma_m, g.cell_m, width);
  }
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      if (!std::isnan(tells.plane_m.at(r, c))) {
        Take(HeightOf(tells, bumps, {r, c}), {r, c}, map);
      }
    }
  }
}

}  // namespace palace
