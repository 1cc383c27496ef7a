// The exact LMedS fit of a row of cells, some cells side by side. Included by slad_loops_table.h
// only.
#pragma once

#include "engine/core/lanes/float_lanes.h"
#include "engine/slad/hazards/loops/lmeds_tables.h"
#include "engine/slad/hazards/loops/slad_loops.h"

namespace palace {
namespace {

// Rousseeuw's finite-sample robust scale, 1.4826 (1 + 5 / (n - 3)), times 2.5.
constexpr float kRobustScale = 2.5F * 1.4826F;
constexpr float kInfinite = __builtin_inff();

/// Windows side by side, one a lane: heights above a reference, NaN where unknown.
struct Windows {
  FloatLanes z[kWindowPoints];
  FloatLanes known;  ///< how many of the nine
};

struct WindowPlanes {
  FloatLanes height, east, south;  ///< per sample spacing
};

template <int kFirst, int kEnd, typename Body>
inline __attribute__((always_inline)) void Unrolled(Body& body) {
  if constexpr (kEnd - kFirst == 1) {
    body.template operator()<kFirst>();
  } else {
    constexpr int kMiddle = (kFirst + kEnd) / 2;
    Unrolled<kFirst, kMiddle>(body);
    Unrolled<kMiddle, kEnd>(body);
  }
}

/// |D| of each quadruple: 126 of them serve all 504 residuals.
template <bool kComplete>
inline __attribute__((always_inline)) void FindDeterminants(const Windows& windows,
                                                            FloatLanes* determinant) {
  auto one = [&]<int q>() __attribute__((always_inline)) {
    constexpr WindowQuadruple quad = kLmeds.quadruples[q];
    bool first = true;
    FloatLanes sum = Fill(0);
    for (int n = 0; n < 4; ++n) {
      // A complete window's heights are above its middle, which is then 0.
      if (quad.weight[n] == 0 || (kComplete && quad.point[n] == 4)) {
        continue;
      }
      const FloatLanes z = windows.z[quad.point[n]];
      const FloatLanes term =
          quad.weight[n] == 1 ? z : Fill(static_cast<float>(quad.weight[n])) * z;
      sum = first ? term : sum + term;
      first = false;
    }
    determinant[q] = Abs(sum);
    if constexpr (!kComplete) {
      // A weight of 0 must not hide that a point is unknown.
      const FloatLanes all = windows.z[quad.point[0]] + windows.z[quad.point[1]] +
                             windows.z[quad.point[2]] + windows.z[quad.point[3]];
      determinant[q] = Select(IsNan(all), Fill(kInfinite), determinant[q]);
    }
  };
  Unrolled<0, kQuadruples>(one);
}

/// The median of the nine residuals is the second smallest of the six beside the triple's own; of
/// seven or six known ones, the smallest.
template <bool kComplete>
inline __attribute__((always_inline)) void FindBestTriple(const Windows& windows,
                                                          const FloatLanes* determinant,
                                                          FloatLanes& best, FloatLanes& index) {
  best = Fill(kInfinite);
  index = Fill(0);
  const LaneMask few = Less(windows.known, Fill(7.5F));
  auto one = [&]<int t>() __attribute__((always_inline)) {
    constexpr WindowTriple triple = kLmeds.triples[t];
    const auto d = [&](int n) __attribute__((always_inline)) {
      return determinant[triple.quadruple[n]];
    };
    // Smallest and second smallest, merged pair by pair.
    const FloatLanes a = Min(d(0), d(1)), b = Max(d(0), d(1));
    const FloatLanes low1 = Min(d(2), d(3)), high1 = Max(d(2), d(3));
    const FloatLanes low2 = Min(d(4), d(5)), high2 = Max(d(4), d(5));
    const FloatLanes a1 = Min(a, low1), b1 = Min(Max(a, low1), Min(b, high1));
    FloatLanes median = Min(Max(a1, low2), Min(b1, high2));
    if constexpr (!kComplete) {
      median = Select(few, Min(a1, low2), median);
    }
    if constexpr (triple.area != 1) {
      median = median * Fill(1.0F / static_cast<float>(triple.area));
    }
    index = Select(Less(median, best), Fill(static_cast<float>(t)), index);
    best = Min(median, best);
  };
  Unrolled<0, kTriples>(one);
}

/// The plane through each lane's best triple; 0 where too few samples are known to choose one.
inline WindowPlanes PlanesOfBest(const Windows& windows, FloatLanes index, FloatLanes known) {
  constexpr int kCount = FloatLanes::kCount;
  float z[kWindowPoints][kCount], which[kCount], count[kCount];
  float height[kCount], east[kCount], south[kCount];
  for (int i = 0; i < kWindowPoints; ++i) {
    Store(z[i], windows.z[i]);
  }
  Store(which, index);
  Store(count, known);
  for (int lane = 0; lane < kCount; ++lane) {
    if (count[lane] < kLeastForMedian) {
      height[lane] = east[lane] = south[lane] = 0;
      continue;
    }
    const int t = static_cast<int>(which[lane]);
    const WindowTriple& triple = kLmeds.triples[t];
    const TriplePlane& weight = kLmeds.planes[t];
    const double z0 = static_cast<double>(z[triple.point[0]][lane]);
    const double z1 = static_cast<double>(z[triple.point[1]][lane]);
    const double z2 = static_cast<double>(z[triple.point[2]][lane]);
    const auto sum = [&](const double* w) {
      return static_cast<float>(w[0] * z0 + w[1] * z1 + w[2] * z2);
    };
    height[lane] = sum(weight.height);
    east[lane] = sum(weight.east);
    south[lane] = sum(weight.south);
  }
  return {Load(height), Load(east), Load(south)};
}

/// Least squares over the samples within `threshold` of the start. What is solved for is the
/// correction to the start, which is small: floats keep their digits.
inline WindowPlanes Refit(const Windows& windows, const WindowPlanes& start, FloatLanes threshold) {
  const FloatLanes zero = Fill(0), one = Fill(1);
  FloatLanes w[kWindowPoints], r[kWindowPoints];
  for (int i = 0; i < kWindowPoints; ++i) {
    const FloatLanes plane = start.height + start.east * Fill(static_cast<float>(WindowX(i))) +
                             start.south * Fill(static_cast<float>(WindowY(i)));
    const FloatLanes residual = windows.z[i] - plane;
    const LaneMask inlier = Less(Abs(residual), threshold);
    w[i] = Select(inlier, one, zero);
    r[i] = Select(inlier, residual, zero);
  }
  const FloatLanes west = w[0] + w[3] + w[6], right = w[2] + w[5] + w[8];
  const FloatLanes north = w[0] + w[1] + w[2], bottom = w[6] + w[7] + w[8];
  const FloatLanes n = north + bottom + w[3] + w[4] + w[5];
  const FloatLanes sx = right - west, sxx = right + west;
  const FloatLanes sy = bottom - north, syy = bottom + north;
  const FloatLanes sxy = (w[0] + w[8]) - (w[2] + w[6]);
  const FloatLanes sz = ((r[0] + r[1]) + (r[2] + r[3])) + ((r[4] + r[5]) + (r[6] + r[7])) + r[8];
  const FloatLanes sxz = (r[2] + r[5] + r[8]) - (r[0] + r[3] + r[6]);
  const FloatLanes syz = (r[6] + r[7] + r[8]) - (r[0] + r[1] + r[2]);
  // Normal equations times n. The determinant is a whole number, 0 when no plane is spanned.
  const FloatLanes cxx = n * sxx - sx * sx, cyy = n * syy - sy * sy, cxy = n * sxy - sx * sy;
  const FloatLanes cxz = n * sxz - sx * sz, cyz = n * syz - sy * sz;
  const FloatLanes determinant = cxx * cyy - cxy * cxy;
  const LaneMask spanned = Less(Fill(0.5F), determinant);
  const FloatLanes unknown = Fill(__builtin_nanf(""));
  const FloatLanes east = (cxz * cyy - cyz * cxy) / determinant;
  const FloatLanes south = (cyz * cxx - cxz * cxy) / determinant;
  const FloatLanes height = (sz - east * sx - south * sy) / n;
  return {Select(spanned, start.height + height, unknown),
          Select(spanned, start.east + east, unknown),
          Select(spanned, start.south + south, unknown)};
}

template <bool kComplete>
inline WindowPlanes FitWindows(const Windows& windows) {
  FloatLanes determinant[kQuadruples], best, index;
  FindDeterminants<kComplete>(windows, determinant);
  FindBestTriple<kComplete>(windows, determinant, best, index);
  const FloatLanes floor = Fill(kLeastThreshold_m);
  if constexpr (kComplete) {
    return Refit(windows, PlanesOfBest(windows, index, windows.known),
                 Max(best * Fill(kRobustScale * (1 + 5.0F / 6)), floor));
  }
  const FloatLanes scale = Fill(kRobustScale) * (Fill(1) + Fill(5) / (windows.known - Fill(3)));
  const LaneMask few = Less(windows.known, Fill(kLeastForMedian));
  const FloatLanes threshold = Select(few, Fill(kInfinite), Max(best * scale, floor));
  return Refit(windows, PlanesOfBest(windows, index, windows.known), threshold);
}

/// Heights of the windows around the cells that start at column c.
inline Windows WindowsAt(const float* const* rows, int stride, int c, bool& complete,
                         FloatLanes& reference) {
  Windows windows;
  FloatLanes sum = Fill(0);
  for (int i = 0; i < kWindowPoints; ++i) {
    windows.z[i] = Load(rows[i / 3] + c + WindowX(i) * stride);
    sum = sum + windows.z[i];
  }
  reference = windows.z[4];
  windows.known = Fill(9);
  complete = !Any(IsNan(sum));
  if (!complete) {
    windows.known = Fill(0);
    for (int i = 0; i < kWindowPoints; ++i) {
      const LaneMask unknown = IsNan(windows.z[i]);
      windows.known = windows.known + Select(unknown, Fill(0), Fill(1));
      reference = Select(IsNan(reference), windows.z[i], reference);
    }
  }
  for (int i = 0; i < kWindowPoints; ++i) {
    windows.z[i] = windows.z[i] - reference;
  }
  return windows;
}

void FitPlaneRow(const float* const* rows, int stride, float spacing_m, int count,
                 const PlaneRow& out) {
  constexpr int kCount = FloatLanes::kCount;
  const FloatLanes spacing = Fill(spacing_m);
  for (int c = 0; c < count; c += kCount) {
    bool complete = false;
    FloatLanes reference;
    const Windows windows = WindowsAt(rows, stride, c, complete, reference);
    const WindowPlanes plane = complete ? FitWindows<true>(windows) : FitWindows<false>(windows);
    float height[kCount], residual[kCount], north[kCount], east[kCount];
    Store(height, reference + plane.height);
    Store(residual, windows.z[4] - plane.height);
    Store(north, (Fill(0) - plane.south) / spacing);
    Store(east, plane.east / spacing);
    for (int k = 0; k < kCount && c + k < count; ++k) {
      out.height_m[c + k] = height[k];
      out.residual_m[c + k] = residual[k];
      out.north_gradient[c + k] = north[k];
      out.east_gradient[c + k] = east[k];
    }
  }
}

}  // namespace
}  // namespace palace
