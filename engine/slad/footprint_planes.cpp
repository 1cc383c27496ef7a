// Robust weighted least-squares planes over the footprint around every cell, by moving sums.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "engine/slad/plane_fit.h"

namespace palace {
namespace {

/// Weighted sums over a window: w, wx, wy, wxx, wxy, wyy, wz, wxz, wyz, wzz, count, variance.
/// x is columns east, y is rows south of the map's middle; z metres above the reference.
using Moments = Eigen::Array<double, 12, 1>;

/// A perfect cell's weight stays finite: variances below (1 cm)^2 count alike.
constexpr double kVarianceFloor_m2 = 1e-4;
/// Stereo noise is shared by this many neighbouring cells.
constexpr double kCorrelatedCells = 4;
/// Cells this far off their plane are kept whatever their noise.
constexpr double kKeep_m = 0.02;
constexpr int kPasses = 3;

struct Solution {
  double height = 0, east = 0, south = 0;  ///< in cells, at the cell asked for
  double scatter = 0;                      ///< rms weighted residual, metres
  double gradient_sigma = 0;               ///< per cell
  double cell_variance = 0;
  bool known = false;
};

/// Solves the plane at cell offset (cx, cy) from the map's middle.
Solution Solve(const Moments& m, double cx, double cy) {
  Solution s;
  const double w = m[0], count = m[10];
  if (count < 2.5 || w <= 0) {
    return s;
  }
  const double mx = m[1] / w, my = m[2] / w, mz = m[6] / w;
  const double sxx = m[3] - w * mx * mx, sxy = m[4] - w * mx * my, syy = m[5] - w * my * my;
  const double sxz = m[7] - w * mx * mz, syz = m[8] - w * my * mz, szz = m[9] - w * mz * mz;
  const double determinant = sxx * syy - sxy * sxy;
  if (determinant < 1e-3 * w * w) {
    return s;
  }
  s.east = (sxz * syy - syz * sxy) / determinant;
  s.south = (syz * sxx - sxz * sxy) / determinant;
  s.height = mz + s.east * (cx - mx) + s.south * (cy - my);
  const double squares = std::max(0.0, szz - s.east * sxz - s.south * syz);
  s.scatter = std::sqrt(squares / w);
  s.cell_variance = m[11] / count;
  // Weights are floor / variance, so the covariance carries the floor; chi-square above 1 widens.
  const double chi2 = count > 3.5 ? squares / kVarianceFloor_m2 / (count - 3) : 1.0;
  const double scale = kVarianceFloor_m2 * std::max(1.0, chi2) * kCorrelatedCells / determinant;
  const double length = std::hypot(s.east, s.south);
  const double ux = length > 1e-9 ? s.east / length : 1.0,
               uy = length > 1e-9 ? s.south / length : 0;
  s.gradient_sigma =
      std::sqrt(std::max(0.0, scale * (ux * ux * syy - 2 * ux * uy * sxy + uy * uy * sxx)));
  s.known = true;
  return s;
}

class FootprintFit {
 public:
  FootprintFit(const ElevationMap& map, double diameter_m)
      : map_(map), rows_(map.geometry.rows), cols_(map.geometry.cols), weight_(rows_, cols_, 0.0) {
    // Half side of the square with the circle's area, in whole cells.
    const double side = diameter_m * std::sqrt(M_PI) / 2 / map.geometry.cell_m;
    half_ = std::max(1, static_cast<int>(std::lround((side - 1) / 2)));
    double sum = 0;
    int count = 0;
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        if (map.state.at(r, c) == CellState::kMeasured) {
          weight_.at(r, c) = FullWeight(r, c);
          sum += static_cast<double>(map.height_m.at(r, c));
          ++count;
        }
      }
    }
    reference_m_ = count > 0 ? sum / count : 0;
    solutions_ = Grid<Solution>(rows_, cols_);
  }

  Grid<Solution> Run() {
    for (int pass = 0; pass < kPasses; ++pass) {
      SolveAll();
      if (pass + 1 < kPasses) {
        RejectOutliers();
      }
    }
    return std::move(solutions_);
  }
  double reference_m() const { return reference_m_; }

 private:
  double FullWeight(int r, int c) const {
    return kVarianceFloor_m2 / (static_cast<double>(map_.variance_m2.at(r, c)) + kVarianceFloor_m2);
  }

  void AddCell(int r, int c, double sign, Moments& sum) const {
    const double w = weight_.at(r, c);
    if (w <= 0) {
      return;
    }
    const double x = c - cols_ / 2, y = r - rows_ / 2;
    const double z = static_cast<double>(map_.height_m.at(r, c)) - reference_m_;
    const double sw = sign * w;
    Moments cell;
    cell << sw, sw * x, sw * y, sw * x * x, sw * x * y, sw * y * y, sw * z, sw * x * z, sw * y * z,
        sw * z * z, sign, sign * static_cast<double>(map_.variance_m2.at(r, c));
    sum += cell;
  }

  void AddRow(int r, double sign, std::vector<Moments>& columns) const {
    if (r < 0 || r >= rows_) {
      return;
    }
    for (int c = 0; c < cols_; ++c) {
      AddCell(r, c, sign, columns[static_cast<std::size_t>(c)]);
    }
  }

  /// Sums of columns slide down the map; along each row the window slides over those sums.
  void SolveAll() {
    std::vector<Moments> columns(static_cast<std::size_t>(cols_), Moments::Zero());
    for (int r = 0; r < half_; ++r) {
      AddRow(r, 1, columns);
    }
    for (int r = 0; r < rows_; ++r) {
      AddRow(r + half_, 1, columns);
      AddRow(r - half_ - 1, -1, columns);
      Moments window = Moments::Zero();
      for (int c = 0; c < std::min(half_, cols_); ++c) {
        window += columns[static_cast<std::size_t>(c)];
      }
      for (int c = 0; c < cols_; ++c) {
        if (c + half_ < cols_) {
          window += columns[static_cast<std::size_t>(c + half_)];
        }
        if (c - half_ - 1 >= 0) {
          window -= columns[static_cast<std::size_t>(c - half_ - 1)];
        }
        const Solution s = Solve(window, c - cols_ / 2, r - rows_ / 2);
        // With all its ground rejected a cell keeps the plane of the pass before.
        if (s.known) {
          solutions_.at(r, c) = s;
        }
      }
    }
  }

  void RejectOutliers() {
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        const Solution& s = solutions_.at(r, c);
        if (map_.state.at(r, c) != CellState::kMeasured || !s.known) {
          continue;
        }
        const double off = static_cast<double>(map_.height_m.at(r, c)) - reference_m_ - s.height;
        const double sigma = std::sqrt(static_cast<double>(map_.variance_m2.at(r, c)));
        const double keep = 3 * sigma + kKeep_m;
        // An obstacle lifts the plane of the ground beside it: ground then lies far below its own
        // plane and must stay, the obstacle stands above it and must go.
        const bool outlier = off > keep + 0.5 * s.scatter || off < -keep - 1.5 * s.scatter;
        weight_.at(r, c) = outlier ? 0.0 : FullWeight(r, c);
      }
    }
  }

  const ElevationMap& map_;
  int rows_, cols_;
  int half_ = 1;
  double reference_m_ = 0;
  Grid<double> weight_;
  Grid<Solution> solutions_;
};

}  // namespace

FootprintPlanes FitFootprintPlanes(const ElevationMap& map, double footprint_diameter_m) {
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  const GridF unknown(rows, cols, kUnknownValue);
  FootprintPlanes planes{{unknown, unknown, unknown, unknown}, unknown, unknown};
  if (unknown.empty()) {
    return planes;
  }
  FootprintFit fit(map, footprint_diameter_m);
  const Grid<Solution> solutions = fit.Run();
  const double cell_m = map.geometry.cell_m;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const Solution& s = solutions.at(r, c);
      if (!s.known) {
        continue;
      }
      planes.plane.height_m.at(r, c) = static_cast<float>(s.height + fit.reference_m());
      planes.plane.residual_m.at(r, c) = static_cast<float>(
          static_cast<double>(map.height_m.at(r, c)) - fit.reference_m() - s.height);
      planes.plane.east_gradient.at(r, c) = static_cast<float>(s.east / cell_m);
      planes.plane.north_gradient.at(r, c) = static_cast<float>(-s.south / cell_m);
      planes.gradient_sigma.at(r, c) = static_cast<float>(s.gradient_sigma / cell_m);
      planes.cell_variance_m2.at(r, c) = static_cast<float>(s.cell_variance);
    }
  }
  return planes;
}

}  // namespace palace
