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

}  // namespace

void TakeFineGround(const FineSums& sums, ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  const GridGeometry& places = sums.places();
  constexpr int kPerCell = NarrowFigures::kPerCell;
  const int side = sums.side();
  const GridF unknown(g.rows, g.cols, kUnknownValue);
  GridF plane_m = unknown, plane_variance_m2 = unknown;
  std::vector<Details> details(kSquares.size(), Details{unknown, unknown});
  cv::parallel_for_(cv::Range(0, g.rows), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      for (int c = 0; c < g.cols; ++c) {
        if (map.state.at(r, c) != CellState::kMeasured) {
          continue;
        }
        const int row = kPerCell * r + 1, col = kPerCell * c + 1;  // the corner in its middle
        const FinePlane plane = PlaneThrough(sums.Over(row, col, kPlaneSquares * side));
        const double x = col - 0.5 - places.cols / 2.0, y = row - 0.5 - places.rows / 2.0;
        if (!plane.told || !(plane.Aside(x, y) <= kMostAside)) {
          continue;
        }
        plane_m.at(r, c) = static_cast<float>(plane.At(x, y) + sums.reference_m());
        plane_variance_m2.at(r, c) =
            static_cast<float>((1 + plane.Aside(x, y)) * plane.variance_m2);
        double coarser_m = 0, coarser_m2 = 0;
        for (std::size_t k = kSquares.size(); k-- > 0;) {
          const FineSum own = sums.Over(row, col, kSquares[k] * side);
          if (!own.known()) {
            break;
          }
          const double off_m = own.height_m() - plane.At(own.x(), own.y());
          const double noise_m2 = own.variance_m2();
          details[k].off_m.at(r, c) = static_cast<float>(off_m - coarser_m);
          // Squares are nested: what is new in the smaller one.
          details[k].sigma_m.at(r, c) =
              static_cast<float>(std::sqrt(std::max(noise_m2 - coarser_m2, noise_m2 / 4)));
          coarser_m = off_m;
          coarser_m2 = noise_m2;
        }
      }
    }
  });
  std::vector<GroundBumps> bumps;
  for (std::size_t k = 0; k < details.size(); ++k) {
    const int width = std::max(1, kSquares[k] * side / kPerCell);
    bumps.emplace_back(details[k].off_m, details[k].sigma_m, g.cell_m, width);
  }
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      if (std::isnan(plane_m.at(r, c))) {
        continue;
      }
      double height_m = static_cast<double>(plane_m.at(r, c));
      double variance_m2 = static_cast<double>(plane_variance_m2.at(r, c));
      for (std::size_t k = 0; k < details.size(); ++k) {
        const double bumps_m2 = Square(bumps[k].At(r, c));
        const auto off_m = static_cast<double>(details[k].off_m.at(r, c));
        if (std::isnan(off_m)) {
          variance_m2 += bumps_m2;  // nothing is told of the bump
          continue;
        }
        const double noise_m2 = Square(static_cast<double>(details[k].sigma_m.at(r, c)));
        const double sigmas = std::abs(off_m) / std::sqrt(bumps_m2 + noise_m2);
        const double no_bump =
            std::clamp((sigmas - kBump_sigmas) / (kStandsOut_sigmas - kBump_sigmas), 0.0, 1.0);
        const double weight = std::max(bumps_m2 / (bumps_m2 + noise_m2), no_bump);
        height_m += weight * off_m;
        variance_m2 += weight * noise_m2;
      }
      float& measured_m = map.measured_m.at(r, c);
      float& own_m2 = map.variance_m2.at(r, c);
      const double off_m = height_m - static_cast<double>(measured_m);
      const auto stereo_m2 = static_cast<double>(own_m2);
      if (variance_m2 >= stereo_m2 ||
          std::abs(off_m) > kStandsOut_sigmas * std::sqrt(stereo_m2 + variance_m2) + kDenied_m) {
        continue;
      }
      map.height_m.at(r, c) += static_cast<float>(off_m);
      measured_m = static_cast<float>(height_m);
      own_m2 = static_cast<float>(variance_m2);
    }
  }
}

}  // namespace palace
