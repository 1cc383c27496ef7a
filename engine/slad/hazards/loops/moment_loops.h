// Weighted least-squares planes over a square window around each cell of a row, by moving sums.
// Included by slad_loops_table.h only. Plain loops for the compiler to
// vectorise: one moment after another, columns side by side.
#pragma once

#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

void AddMomentsRow(const float* weight, const float* height, const float* variance, int x0,
                   double y, double sign, int count, int pitch, double* columns) {
  double* __restrict__ m[kMoments];
  for (int k = 0; k < kMoments; ++k) {
    m[k] = columns + k * pitch;
  }
  double* __restrict__ m0 = m[0];
  double* __restrict__ mx = m[1];
  double* __restrict__ my = m[2];
  double* __restrict__ mxx = m[3];
  double* __restrict__ mxy = m[4];
  double* __restrict__ myy = m[5];
  double* __restrict__ mz = m[6];
  double* __restrict__ mxz = m[7];
  double* __restrict__ myz = m[8];
  double* __restrict__ mzz = m[9];
  double* __restrict__ mn = m[10];
  double* __restrict__ mv = m[11];
  for (int c = 0; c < count; ++c) {
    const double x = c + x0;
    const double one = weight[c] > 0 ? sign : 0;
    const double w = sign * static_cast<double>(weight[c]);
    const double z = static_cast<double>(height[c]);
    const double wx = w * x, wy = w * y, wz = w * z;
    m0[c] += w;
    mx[c] += wx;
    my[c] += wy;
    mxx[c] += wx * x;
    mxy[c] += wx * y;
    myy[c] += wy * y;
    mz[c] += wz;
    mxz[c] += wz * x;
    myz[c] += wz * y;
    mzz[c] += wz * z;
    mn[c] += one;
    mv[c] += one * static_cast<double>(variance[c]);
  }
}

/// sums[c] = columns[c - half] + .. + columns[c + half], from runs of 1, 2, 4 .. columns.
inline void WindowSums(const double* columns, int half, int count, double* __restrict__ work,
                       double* __restrict__ sums) {
  const int length = count + 2 * half, width = 2 * half + 1;
  const double* single = columns - half;
  // The width is odd.
  for (int c = 0; c < count; ++c) {
    sums[c] = single[c];
  }
  for (int k = 0; k + 2 <= length; ++k) {
    work[k] = single[k] + single[k + 1];
  }
  int offset = 1;
  for (int run = 2; run <= width; run *= 2) {
    if ((width & run) != 0) {
      for (int c = 0; c < count; ++c) {
        sums[c] += work[c + offset];
      }
      offset += run;
    }
    if (2 * run <= width) {
      for (int k = 0; k + 2 * run <= length; ++k) {
        work[k] += work[k + run];
      }
    }
  }
}

constexpr int kSolveRun = 64;  // columns
/// Determinant of the window's second moments, per squared weight, from which it spans a plane.
constexpr double kLeastSpan = 1e-3;

/// Planes of some columns from the sums of their windows, moment k at sums + k pitch. Doubles into
/// arrays of their own first, floats after: else none of it is vectorised.
inline void SolveRun(const double* sums, int pitch, double first_x, double y, int first, int count,
                     const FittedRow& out) {
  const auto sum = [&](int k) { return sums + k * pitch + first; };
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
  double* sums = work + pitch;
  for (int k = 0; k < kMoments; ++k) {
    WindowSums(columns + k * pitch, half, count, work, sums + k * pitch);
  }
  for (int c = 0; c < count; c += kSolveRun) {
    SolveRun(sums, pitch, c + x0, y, c, count - c < kSolveRun ? count - c : kSolveRun, out);
  }
}

}  // namespace
}  // namespace palace
