// Weighted least-squares planes over a square window around each cell of a row, by moving sums.
// Included by slad_loops_table.h only. Plain loops for the compiler to
// vectorise, columns side by side.
#pragma once

#include "engine/core/lanes/double_lanes.h"
#include "engine/core/lanes/float_lanes.h"
#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/loops/window_sum_loops.h"

namespace palace {
namespace {

/// Cells this far off their plane are kept whatever their noise; those farther off by so many
/// sigmas and shares of the plane's scatter, above it and below it, are not.
constexpr float kKeep_m = 0.02F;
constexpr float kKeepSigmas = 3;
constexpr float kKeepAbove = 0.5F, kKeepBelow = 1.5F;

/// Each column's sums stay in registers while its rows are added, one after the other.
void AddMomentRows(const MomentRow* rows, int row_count, int x0, int count, int pitch,
                   double* columns) {
  DoubleLanes lanes_from_0{};
  for (int k = 0; k < DoubleLanes::kCount; ++k) {
    lanes_from_0.v[k] = k;
  }
  for (int c = 0; c < count; c += DoubleLanes::kCount) {
    const DoubleLanes x = FillDoubles(c + x0) + lanes_from_0;
    DoubleLanes sum[kMoments];
    for (int k = 0; k < kMoments; ++k) {
      sum[k] = Load(columns + k * pitch + c);
    }
    for (int r = 0; r < row_count; ++r) {
      const MomentRow& row = rows[r];
      const DoubleLanes weight = Widened(row.weight + c), z = Widened(row.height_m + c);
      const DoubleLanes sign = FillDoubles(row.sign), y = FillDoubles(row.y);
      const DoubleLanes one = WherePositive(weight, sign), w = sign * weight;
      const DoubleLanes wx = w * x, wy = w * y, wz = w * z;
      const DoubleLanes moment[kMoments] = {
          w,  wx,     wy,     wx * x, wx * y, wy * y,
          wz, wz * x, wz * y, wz * z, one,    one * Widened(row.variance_m2 + c)};
      for (int k = 0; k < kMoments; ++k) {
        sum[k] = sum[k] + moment[k];
      }
    }
    for (int k = 0; k < kMoments; ++k) {
      Store(columns + k * pitch + c, sum[k]);
    }
  }
}

/// Weights of the next pass: 0 where a cell stands off its plane. Whether any of them is new.
bool RejectOutliersRow(const CheckedRow& row, int count, float* weight) {
  const FloatLanes sigmas = Fill(kKeepSigmas), least = Fill(kKeep_m), none = Fill(0.0F);
  bool changed = false;
  for (int c = 0; c < count; c += FloatLanes::kCount) {
    const FloatLanes plane = Load(row.plane_m + c), scatter = Load(row.scatter_m + c);
    const FloatLanes off = Load(row.height_m + c) - plane;
    const FloatLanes keep = sigmas * SquareRoot(Load(row.variance_m2 + c)) + least;
    // An obstacle lifts the plane of the ground beside it: ground then lies far below its own
    // plane and must stay, the obstacle stands above it and must go.
    const FloatLanes high = keep + Fill(kKeepAbove) * scatter;
    const FloatLanes low = none - keep - Fill(kKeepBelow) * scatter;
    const FloatLanes before = Load(weight + c);
    const FloatLanes judged =
        Select(Less(high, off), none, Select(Less(off, low), none, Load(row.full_weight + c)));
    const FloatLanes after = Select(IsNan(plane), before, judged);
    changed = Any(Differ(after, before)) || changed;
    Store(weight + c, after);
  }
  return changed;
}

/// Determinant of the window's second moments, per squared weight, from which it spans a plane.
constexpr double kLeastSpan = 1e-3;

/// Planes of some columns from the sums of their windows, moment k at sums + k pitch. Doubles into
/// arrays of their own first, floats after: else none of it is vectorised.
inline void SolveRun(const double* sums, int pitch, double first_x, double y, int first, int count,
                     const FittedRow& out) {
  const auto sum = [&](int k) { return sums + k * pitch; };
  const double *m0 = sum(0), *m1 = sum(1), *m2 = sum(2), *m3 = sum(3), *m4 = sum(4), *m5 = sum(5),
               *m6 = sum(6), *m7 = sum(7), *m8 = sum(8), *m9 = sum(9), *mn = sum(10), *mv = sum(11);
  double x[kSolveRun], height[kSolveRun], easts[kSolveRun], souths[kSolveRun], scatter2[kSolveRun],
      sigma2[kSolveRun], variance[kSolveRun], known[kSolveRun];
  for (int c = 0; c < count; ++c) {
    x[c] = first_x + c;
  }
  for (int c = 0; c < count; ++c) {
    const double w = m0[c] > 0 ? m0[c] : 1, n = mn[c];
    const double x_mean = m1[c] / w, y_mean = m2[c] / w, z_mean = m6[c] / w;
    const double sxx = m3[c] - w * x_mean * x_mean, sxy = m4[c] - w * x_mean * y_mean,
                 syy = m5[c] - w * y_mean * y_mean;
    const double sxz = m7[c] - w * x_mean * z_mean, syz = m8[c] - w * y_mean * z_mean,
                 szz = m9[c] - w * z_mean * z_mean;
    const double determinant = sxx * syy - sxy * sxy;
    const double enough = n >= 2.5 ? determinant : -1;
    const double weighed = m0[c] > 0 ? enough : -1;
    const double least = kLeastSpan * w * w;
    const double d = weighed >= least ? determinant : 1;
    const double east = (sxz * syy - syz * sxy) / d, south = (syz * sxx - sxz * sxy) / d;
    const double left = szz - east * sxz - south * syz, squares = left > 0 ? left : 0;
    // Weights are floor / variance, so the covariance carries the floor; chi-square above 1 widens.
    const double freedom = n > 3.5 ? n - 3 : 1;
    const double chi2 = n > 3.5 ? squares / kVarianceFloor_m2 / freedom : 1;
    const double scale = kVarianceFloor_m2 * (chi2 > 1 ? chi2 : 1) * kCorrelatedCells / d;
    // Along the steepest direction; any on level ground.
    const double steep2 = east * east + south * south;
    const double ee = steep2 < 1e-18 ? 1 : east * east, ss = steep2 < 1e-18 ? 0 : south * south,
                 es = steep2 < 1e-18 ? 0 : east * south, unit = steep2 < 1e-18 ? 1 : steep2;
    const double along = scale * (ee * syy - 2 * es * sxy + ss * sxx) / unit;
    height[c] = z_mean + east * (x[c] - x_mean) + south * (y - y_mean);
    easts[c] = east;
    souths[c] = south;
    scatter2[c] = squares / w;
    sigma2[c] = along > 0 ? along : 0;
    variance[c] = mv[c] / (n > 0 ? n : 1);
    known[c] = weighed >= least ? 1 : 0;
  }
  for (int c = 0; c < count; ++c) {
    scatter2[c] = __builtin_sqrt(scatter2[c]);
    sigma2[c] = __builtin_sqrt(sigma2[c]);
  }
  // With all its ground rejected a cell keeps the plane of the pass before.
  const auto keep = [&](const double* from, float* to) {
    for (int c = 0; c < count; ++c) {
      to[first + c] = known[c] > 0 ? static_cast<float>(from[c]) : to[first + c];
    }
  };
  keep(height, out.height_m);
  keep(easts, out.east);
  keep(souths, out.south);
  keep(scatter2, out.scatter_m);
  keep(sigma2, out.gradient_sigma);
  keep(variance, out.cell_variance_m2);
}

void SolveMomentsRow(const double* columns, int pitch, int half, int x0, double y, int count,
                     double* work, const FittedRow& out) {
  double sums[kMoments * kSolveRun];
  for (int c = 0; c < count; c += kSolveRun) {
    const int run = count - c < kSolveRun ? count - c : kSolveRun;
    for (int k = 0; k < kMoments; ++k) {
      WindowSums(columns + k * pitch + c, half, work, sums + k * kSolveRun);
    }
    SolveRun(sums, kSolveRun, c + x0, y, c, run, out);
  }
}

}  // namespace
}  // namespace palace
