// Loops of the correlation refinement, written so that compilers turn them into SIMD.
// Included by one source file for each instruction set, so it stays clear of every inline function
// of other headers: the linker could keep the copy that the processor at hand cannot run.
#pragma once

#include "engine/stereo/stereo_loops.h"

namespace palace {
namespace {

inline float Smaller(float a, float b) { return a < b ? a : b; }
inline float Larger(float a, float b) { return a > b ? a : b; }
inline float Size(float a) { return a < 0.0F ? -a : a; }

// ---- the number of taps is known to the compiler: sums stay in registers ----

template <int kTaps>
inline float SumTaps(const float* p) {
  if constexpr (kTaps == 1) {
    return p[0];
  } else {
    return SumTaps<kTaps - 1>(p) + p[kTaps - 1];
  }
}

template <int kHalf>
void SumAlongBy(const float* __restrict columns, int width, float* __restrict out) {
  for (int x = 0; x < width; ++x) {
    out[x] = SumTaps<2 * kHalf + 1>(columns + x);
  }
}

/// Differences to the centre that are taken into the mean, and how many.
struct Near {
  float sum = 0;
  float count = 1;  // the centre itself
};

/// Two values at the same distance on both sides. Each counts when it lies within the limit of the
/// centre; both count when their mean does so by half of it: steep ground, where they differ from
/// the centre by as much up as down.
inline void AddPair(float before, float after, float centre, float limit, Near& near) {
  const float a = before - centre;
  const float b = after - centre;
  const bool steep = Size(a + b) <= limit;
  const float share_a = (Size(a) <= limit) | steep ? 1.0F : 0.0F;
  const float share_b = (Size(b) <= limit) | steep ? 1.0F : 0.0F;
  near.sum += share_a * a + share_b * b;
  near.count += share_a + share_b;
}

template <int kHalf>
inline void AddPairsAlong(const float* centre, float limit, Near& near) {
  if constexpr (kHalf > 0) {
    AddPairsAlong<kHalf - 1>(centre, limit, near);
    AddPair(centre[-kHalf], centre[kHalf], centre[0], limit, near);
  }
}

template <int kHalf>
void SmoothAlongBy(const float* __restrict values, int width, float limit, float* __restrict out) {
  for (int x = 0; x < width; ++x) {
    Near near;
    AddPairsAlong<kHalf>(values + x, limit, near);
    out[x] = values[x] + near.sum / near.count;
  }
}

template <int kHalf>
inline void AddPairsDown(const float* const* centre_row, int x, float limit, Near& near) {
  if constexpr (kHalf > 0) {
    AddPairsDown<kHalf - 1>(centre_row, x, limit, near);
    AddPair(centre_row[-kHalf][x], centre_row[kHalf][x], centre_row[0][x], limit, near);
  }
}

template <int kHalf>
void SmoothDownBy(const float* const* rows, int width, float limit, const float* __restrict start,
                  float max_shift, float* __restrict out) {
  const float* row[2 * kHalf + 1];
  for (int k = 0; k < 2 * kHalf + 1; ++k) {
    row[k] = rows[k];
  }
  for (int x = 0; x < width; ++x) {
    Near near;
    AddPairsDown<kHalf>(row + kHalf, x, limit, near);
    const float smooth = row[kHalf][x] + near.sum / near.count;
    out[x] = Smaller(Larger(smooth, start[x] - max_shift), start[x] + max_shift);
  }
}

/// Calls rule.Run<half>().
template <typename Rule>
inline void ForHalf(int half, const Rule& rule) {
  switch (half) {
    case 1:
      return rule.template Run<1>();
    case 2:
      return rule.template Run<2>();
    case 3:
      return rule.template Run<3>();
    case 4:
      return rule.template Run<4>();
    case 5:
      return rule.template Run<5>();
    case 6:
      return rule.template Run<6>();
    case 7:
      return rule.template Run<7>();
    case 8:
      return rule.template Run<8>();
    case 9:
      return rule.template Run<9>();
    default:
      return rule.template Run<kLargestHalf_px>();
  }
}

struct SumAlongRule {
  const float* columns;
  int width;
  float* out;
  template <int kHalf>
  void Run() const {
    SumAlongBy<kHalf>(columns, width, out);
  }
};

void SumAlong(const float* columns, int half, int width, float* out) {
  ForHalf(half, SumAlongRule{columns, width, out});
}

struct SmoothAlongRule {
  const float* values;
  int width;
  float limit;
  float* out;
  template <int kHalf>
  void Run() const {
    SmoothAlongBy<kHalf>(values, width, limit, out);
  }
};

void SmoothAlong(const float* values, int half, int width, float limit, float* out) {
  ForHalf(half, SmoothAlongRule{values, width, limit, out});
}

struct SmoothDownRule {
  const float* const* rows;
  int width;
  float limit;
  const float* start;
  float max_shift;
  float* out;
  template <int kHalf>
  void Run() const {
    SmoothDownBy<kHalf>(rows, width, limit, start, max_shift, out);
  }
};

void SmoothDown(const float* const* rows, int half, int width, float limit, const float* start,
                float max_shift, float* out) {
  ForHalf(half, SmoothDownRule{rows, width, limit, start, max_shift, out});
}

// ---- warp ----

/// Coefficients c of the cubic B-spline through the values: c = s * h, h_k = sqrt(3) z^|k| with
/// z = sqrt(3) - 2 (Unser, Aldroubi & Eden 1993); |z|^8 is 3e-5.
void SplineRow(const float* __restrict values, int width, float* __restrict coefficients) {
  constexpr float kPole = -0.26794919F;
  float weight[kSplineReach_px + 1];
  weight[0] = 1.7320508F;
  for (int k = 1; k <= kSplineReach_px; ++k) {
    weight[k] = weight[k - 1] * kPole;
  }
  for (int x = 0; x < width; ++x) {
    coefficients[x] = weight[0] * values[x];
  }
  for (int k = 1; k <= kSplineReach_px; ++k) {
    const float share = weight[k];
    for (int x = 0; x < width; ++x) {
      coefficients[x] += share * (values[x - k] + values[x + k]);
    }
  }
}

constexpr int kWarpBlock = 64;

// Each block first finds the places, then fetches four pixels for each (the only step that is not
// SIMD), then interpolates.
void WarpRow(const float* __restrict coefficients, const float* __restrict disparity,
             const float* __restrict known, int width, float* __restrict warped) {
  int whole[kWarpBlock];
  float part[kWarpBlock];
  float taps[4][kWarpBlock];
  for (int first = 0; first < width; first += kWarpBlock) {
    const int count = width - first < kWarpBlock ? width - first : kWarpBlock;
    for (int i = 0; i < count; ++i) {
      const int x = first + i;
      const float place = known[x] != 0.0F ? static_cast<float>(x) - disparity[x] : 1.0F;
      whole[i] = static_cast<int>(place);
      part[i] = place - static_cast<float>(whole[i]);
    }
    for (int i = 0; i < count; ++i) {
      const float* p = coefficients + whole[i];
      taps[0][i] = p[-1];
      taps[1][i] = p[0];
      taps[2][i] = p[1];
      taps[3][i] = p[2];
    }
    for (int i = 0; i < count; ++i) {
      const float a = taps[0][i], b = taps[1][i], c = taps[2][i], d = taps[3][i], t = part[i];
      const float u = 1.0F - t;
      const float value = (u * u * u * a + (4.0F - 3.0F * t * t * (1.0F + u)) * b +
                           (4.0F - 3.0F * u * u * (1.0F + t)) * c + t * t * t * d) *
                          (1.0F / 6.0F);
      warped[first + i] = known[first + i] != 0.0F ? value : 0.0F;
    }
  }
}

// ---- windows ----

void Slide(const float* __restrict enter_a, const float* __restrict enter_b,
           const float* __restrict leave_a, const float* __restrict leave_b, int width,
           float* __restrict columns) {
  for (int x = 0; x < width; ++x) {
    columns[x] = columns[x] + enter_a[x] * enter_b[x] - leave_a[x] * leave_b[x];
  }
}

constexpr float kLeastEnergyShare = 0.4F;  // a window whose gradient is mostly noise is refused

// The results are parameters of their own: compilers honour __restrict only there.
inline void FitInto(const FitSums s, const FitLimits limit, int width, float* __restrict step_px,
                    float* __restrict noise_energy, float* __restrict gradient_energy) {
  const float least_square = limit.least_correlation * limit.least_correlation;
  for (int x = 0; x < width; ++x) {
    const float n = Larger(s.n[x], 4.0F);
    const float scale = 1.0F / n;
    const float gg = s.gg[x] - s.g[x] * s.g[x] * scale;
    const float ll = s.ll[x] - s.l[x] * s.l[x] * scale;
    const float lg = s.lg[x] - s.l[x] * s.g[x] * scale;
    const float rr = s.rr[x] - s.r[x] * s.r[x] * scale;
    const float lr = s.lr[x] - s.l[x] * s.r[x] * scale;
    const float rg = s.rg[x] - s.r[x] * s.g[x] * scale;
    const bool good = (s.n[x] >= limit.least_known) & (gg > n * limit.least_variance) &
                      (rr > 0.0F) & (lr > 0.0F) & (lr * lr > least_square * ll * rr);
    const float gain = Smaller(Larger(lr / Larger(rr, 1e-6F), 0.5F), 2.0F);
    const float eg = lg - gain * rg;
    const float ee = ll - gain * (2.0F * lr - gain * rr);
    const float plain = -eg / Larger(gg, 1e-6F);
    const float variance = Larger((ee + eg * plain) / (n - 3.0F), limit.least_variance);
    // Camera noise adds to the gradient's energy but not to e g: without its share the step is not
    // too short on weak texture.
    const float energy = gg - n * limit.gradient_noise_share * variance;
    const bool textured = good & (energy > kLeastEnergyShare * gg);
    const float step = -eg / Larger(energy, Larger(kLeastEnergyShare * gg, 1e-6F));
    step_px[x] = good ? Smaller(Larger(step, -1.0F), 1.0F) : 0.0F;
    noise_energy[x] = variance * gg;
    gradient_energy[x] = textured ? energy : 0.0F;
  }
}

void FitRow(const FitSums& sums, const FitLimits& limits, int width, const RowFit& fit) {
  FitInto(sums, limits, width, fit.step_px, fit.noise_energy, fit.gradient_energy);
}

inline void FinishInto(const RowFit fit, const RowFinish row, int width,
                       float* __restrict disparity_px, float* __restrict sigma_px) {
  const float least = row.least_sigma_px * row.least_sigma_px;
  const float most = row.max_sigma_px * row.max_sigma_px;
  const float unknown = __builtin_nanf("");
  for (int x = 0; x < width; ++x) {
    const float gradient = fit.gradient_energy[x];
    const float energy = Larger(gradient, 1e-6F);
    const float variance = fit.noise_energy[x] / (energy * energy) + least;
    const float d = row.reference[x] + fit.step_px[x];
    const bool good = (row.known[x] != 0.0F) & (gradient > 0.0F) & (variance <= most) &
                      (Size(d - row.start[x]) <= row.max_shift_px);
    disparity_px[x] = good ? d : unknown;
    sigma_px[x] = good ? __builtin_sqrtf(Larger(variance, 0.0F)) : unknown;
  }
}

void FinishRow(const RowFit& fit, int width, const RowFinish& row) {
  FinishInto(fit, row, width, row.disparity_px, row.sigma_px);
}

}  // namespace
}  // namespace palace
