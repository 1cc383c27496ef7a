// Robust footprint planes cell after cell, without lanes, tiles and threads, in the order of
// additions that plane_fit.h's are made in: the fast ones must have the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/plane_fit.h"

namespace palace::testing {

class PlainFootprintFit {
 public:
  PlainFootprintFit(const ElevationMap& map, double diameter_m, const Grid<std::uint8_t>& leave_out)
      : map_(map),
        leave_out_(leave_out),
        rows_(map.geometry.rows),
        cols_(map.geometry.cols),
        weight_(rows_, cols_, 0.0F),
        scatter_m_(rows_, cols_, 0.0F) {
    const GridF unknown(rows_, cols_, kUnknownValue);
    planes_ = {{unknown, unknown, unknown, unknown}, unknown, unknown};
    const double side = diameter_m * std::sqrt(M_PI) / 2 / map.geometry.cell_m;
    half_ = int(
        std::clamp(std::round((side - 1) / 2), 2.0, std::max(2.0, double(std::max(rows_, cols_)))));
    double sum = 0;
    int count = 0;
    ForCells([&](int r, int c) {
      sum += Counts(r, c) ? double(map.height_m.at(r, c)) : 0.0;
      count += Counts(r, c) ? 1 : 0;
    });
    reference_m_ = float(count > 0 ? sum / count : 0);
    ForCells([&](int r, int c) { weight_.at(r, c) = Counts(r, c) ? FullWeight(r, c) : 0.0F; });
  }

  FootprintPlanes Run() {
    Solve();
    for (int pass = 1; pass < 3; ++pass) {
      RejectOutliers();
      Solve();
    }
    const double cell = map_.geometry.cell_m;
    const double correlated = std::clamp(std::pow(0.6 / cell, 2), 1.0, kCorrelatedCells);
    const float scale = float(std::sqrt(correlated / kCorrelatedCells)) / float(cell);
    ForCells([&](int r, int c) {
      float& height_m = planes_.plane.height_m.at(r, c);
      planes_.plane.residual_m.at(r, c) = (map_.height_m.at(r, c) - reference_m_) - height_m;
      height_m += reference_m_;
      planes_.plane.east_gradient.at(r, c) /= float(cell);
      planes_.plane.north_gradient.at(r, c) /= -float(cell);
      planes_.gradient_sigma.at(r, c) *= scale;
    });
    return planes_;
  }

 private:
  using Moments = std::array<double, kMoments>;
  static constexpr int kStripeRows = 32;

  template <typename Visit>
  void ForCells(Visit visit) const {
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        visit(r, c);
      }
    }
  }
  bool Counts(int r, int c) const {
    return map_.state.at(r, c) == CellState::kMeasured &&
           (leave_out_.empty() || (leave_out_.at(r, c) & kFlagElevated) == 0);
  }
  float FullWeight(int r, int c) const {
    constexpr float kFloor = float(kVarianceFloor_m2);
    return kFloor / (map_.variance_m2.at(r, c) + kFloor);
  }
  float Height(int r, int c) const {
    return Counts(r, c) ? map_.height_m.at(r, c) - reference_m_ : 0.0F;
  }
  float Variance(int r, int c) const { return Counts(r, c) ? map_.variance_m2.at(r, c) : 0.0F; }

  void AddRow(int r, double sign, std::vector<Moments>& columns) const {
    for (int c = 0; c < cols_ && r >= 0 && r < rows_; ++c) {
      const double x = c - cols_ / 2, y = r - rows_ / 2, z = double(Height(r, c));
      const double one = weight_.at(r, c) > 0 ? sign : 0, w = sign * double(weight_.at(r, c));
      const double wx = w * x, wy = w * y, wz = w * z;
      const Moments of_cell{w,  wx,     wy,     wx * x, wx * y, wy * y,
                            wz, wz * x, wz * y, wz * z, one,    one * double(Variance(r, c))};
      for (std::size_t k = 0; k < of_cell.size(); ++k) {
        columns[std::size_t(c)][k] += of_cell[k];
      }
    }
  }
  /// Moment k of `run` columns, a power of two: the sum of two halves.
  double RunSum(const std::vector<Moments>& columns, std::size_t k, int first, int run) const {
    if (run == 1) {
      return first >= 0 && first < cols_ ? columns[std::size_t(first)][k] : 0.0;
    }
    return RunSum(columns, k, first, run / 2) + RunSum(columns, k, first + run / 2, run / 2);
  }
  Moments WindowSum(const std::vector<Moments>& columns, int c) const {
    const int width = 2 * half_ + 1;
    Moments sums{};
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] = RunSum(columns, k, c - half_, 1);
      int offset = 1;
      for (int run = 2; run <= width; run *= 2) {
        if ((width & run) != 0) {
          sums[k] += RunSum(columns, k, c - half_ + offset, run);
          offset += run;
        }
      }
    }
    return sums;
  }

  void Solve() {
    for (int first = 0; first < rows_; first += kStripeRows) {
      std::vector<Moments> columns(std::size_t(cols_), Moments{});
      for (int r = first - half_; r < first + half_; ++r) {
        AddRow(r, 1, columns);
      }
      for (int r = first; r < std::min(rows_, first + kStripeRows); ++r) {
        AddRow(r + half_, 1, columns);
        if (r > first) {
          AddRow(r - half_ - 1, -1, columns);
        }
        for (int c = 0; c < cols_; ++c) {
          SolveCell(WindowSum(columns, c), r, c);
        }
      }
    }
  }
  /// The weighted least-squares plane of one window; without one the cell keeps what it has.
  void SolveCell(const Moments& m, int r, int c) {
    const double x = c - cols_ / 2, y = r - rows_ / 2;
    const double w = m[0] > 0 ? m[0] : 1, n = m[10];
    const double x_mean = m[1] / w, y_mean = m[2] / w, z_mean = m[6] / w;
    const double sxx = m[3] - w * x_mean * x_mean, sxy = m[4] - w * x_mean * y_mean,
                 syy = m[5] - w * y_mean * y_mean;
    const double sxz = m[7] - w * x_mean * z_mean, syz = m[8] - w * y_mean * z_mean,
                 szz = m[9] - w * z_mean * z_mean;
    const double d = sxx * syy - sxy * sxy;
    if (!(m[0] > 0 && n >= 2.5 && d >= 1e-3 * w * w)) {
      return;
    }
    const double east = (sxz * syy - syz * sxy) / d, south = (syz * sxx - sxz * sxy) / d;
    const double left = szz - east * sxz - south * syz, squares = left > 0 ? left : 0;
    const double chi2 = n > 3.5 ? squares / kVarianceFloor_m2 / (n - 3) : 1;
    const double scale = kVarianceFloor_m2 * (chi2 > 1 ? chi2 : 1) * kCorrelatedCells / d;
    const double steep2 = east * east + south * south;
    const bool level = steep2 < 1e-18;
    const double along = scale *
                         ((level ? 1 : east * east) * syy - 2 * (level ? 0 : east * south) * sxy +
                          (level ? 0 : south * south) * sxx) /
                         (level ? 1 : steep2);
    planes_.plane.height_m.at(r, c) = float(z_mean + east * (x - x_mean) + south * (y - y_mean));
    planes_.plane.east_gradient.at(r, c) = float(east);
    planes_.plane.north_gradient.at(r, c) = float(south);  // until the last pass
    scatter_m_.at(r, c) = float(std::sqrt(squares / w));
    planes_.gradient_sigma.at(r, c) = float(std::sqrt(along > 0 ? along : 0));
    planes_.cell_variance_m2.at(r, c) = float(m[11] / (n > 0 ? n : 1));
  }
  void RejectOutliers() {
    ForCells([&](int r, int c) {
      const float plane_m = planes_.plane.height_m.at(r, c), scatter_m = scatter_m_.at(r, c);
      if (!Counts(r, c) || std::isnan(plane_m)) {
        return;
      }
      const float off_m = Height(r, c) - plane_m;
      const float keep_m = 3.0F * std::sqrt(Variance(r, c)) + 0.02F;
      const bool outlier = off_m > keep_m + 0.5F * scatter_m || off_m < -keep_m - 1.5F * scatter_m;
      weight_.at(r, c) = outlier ? 0.0F : FullWeight(r, c);
    });
  }

  const ElevationMap& map_;
  const Grid<std::uint8_t>& leave_out_;
  int rows_, cols_, half_ = 2;
  float reference_m_ = 0;
  GridF weight_, scatter_m_;
  FootprintPlanes planes_;
};

/// Beside a raised surface the planes of the ground alone, wherever it spans one.
inline FootprintPlanes PlainFootprintPlanes(const ElevationMap& map, double diameter_m,
                                            const Grid<std::uint8_t>& flags) {
  FootprintPlanes planes = PlainFootprintFit(map, diameter_m, {}).Run();
  if (flags.empty()) {
    return planes;
  }
  const FootprintPlanes ground = PlainFootprintFit(map, diameter_m, flags).Run();
  for (std::size_t i = 0; i < flags.cells().size(); ++i) {
    if ((flags.cells()[i] & kFlagElevated) == 0 && !std::isnan(ground.plane.height_m.cells()[i])) {
      planes.plane.height_m.cells()[i] = ground.plane.height_m.cells()[i];
      planes.plane.residual_m.cells()[i] = ground.plane.residual_m.cells()[i];
      planes.plane.north_gradient.cells()[i] = ground.plane.north_gradient.cells()[i];
      planes.plane.east_gradient.cells()[i] = ground.plane.east_gradient.cells()[i];
      planes.gradient_sigma.cells()[i] = ground.gradient_sigma.cells()[i];
      planes.cell_variance_m2.cells()[i] = ground.cell_variance_m2.cells()[i];
    }
  }
  return planes;
}

}  // namespace palace::testing
