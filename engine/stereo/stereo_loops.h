// Inner loops of the stereo matcher: compiled once for every x86-64 and once for AVX2, chosen at
// run time. Both are made from the same source (semi_global_loops.h, refinement_loops.h) with whole
// numbers and uncontracted floats, so they give the same bits.
#pragma once

#include <cstdint>

namespace palace {

inline constexpr int kCensusPlanes = 3;     ///< bytes of a census code; each has its own plane
inline constexpr int kCensusHalf_px = 3;    ///< half side of the census window
inline constexpr int kDisparityBlock = 32;  ///< disparities are searched in blocks of so many
inline constexpr int kSplineReach_px = 8;   ///< of the filter that finds spline coefficients
inline constexpr int kPathGuard = 16;       ///< bytes between the path costs of two pixels
inline constexpr std::uint8_t kPathGuardCost = 191;  ///< in those bytes: never the cheapest
inline constexpr int kRowsTogether = 2;              ///< rows that AlongRows takes at once

/// What one row's aggregated costs say; arrays of the row's length.
struct RowChoice {
  std::uint8_t* best = nullptr;    ///< index of the least cost, the first of equals
  std::uint8_t* unique = nullptr;  ///< 1: no other disparity comes near, neighbours apart
  std::uint8_t* cost = nullptr;    ///< the least cost, and those of its two neighbours:
  std::uint8_t* below = nullptr;   ///< at best - 1; the least cost itself at the first disparity
  std::uint8_t* above = nullptr;   ///< at best + 1; the same at the last
};

/// One row of window sums. n: known pixels, l, r: grey left and warped right, g: gradient, and
/// their products.
struct FitSums {
  const float *n, *l, *g, *ll, *lg, *gg, *r, *rr, *lr, *rg;
};

struct FitLimits {
  float least_known;           ///< pixels in a window
  float least_correlation;     ///< of left and right
  float least_variance;        ///< the residual variance is never taken as smaller, grey squared
  float gradient_noise_share;  ///< of the residual variance, in the gradient's energy, per pixel
};

/// What the windows of one row say. Where a window is not good, step and gradient energy are 0.
struct RowFit {
  float* step_px;
  float* noise_energy;     ///< residual variance times the whole gradient's energy
  float* gradient_energy;  ///< without the share that is camera noise
};

/// A row to finish: disparity = reference + step where the fit is good enough.
struct RowFinish {
  const float* known;
  const float* start;
  const float* reference;
  float max_shift_px;
  float max_sigma_px;
  float least_sigma_px;  ///< added in quadrature
  float* disparity_px;   ///< NaN where refused
  float* sigma_px;
};

struct StereoLoops {
  // --- semi-global matching; cost layout [column][disparity], 32 * blocks disparities a column ---

  /// Centre-symmetric census (Spangenberg et al. 2013) of one row: 24 bits, one for each pair of
  /// pixels opposite in the 7x7 window. rows: the 7 rows, each padded by 3 pixels on both sides.
  void (*census)(const std::uint8_t* const* rows, int width, std::uint8_t* const* planes);
  /// Differing bits of left(x) and right(x - d). Right planes are reversed: entry columns - 1 - x.
  void (*match)(const std::uint8_t* const* left, const std::uint8_t* const* right_reversed,
                int columns, int blocks, std::uint8_t* cost);
  /// Path cost from the row above; `sum` receives it. Paths have kPathGuard bytes after each pixel.
  void (*down)(const std::uint8_t* cost, int columns, int blocks, int small_jump, int large_jump,
               const std::uint8_t* above, const std::uint8_t* above_least, std::uint8_t* path,
               std::uint8_t* least, std::uint8_t* sum);
  /// Adds the path costs from the left and from the right to the sums of kRowsTogether rows.
  void (*along)(const std::uint8_t* const* cost, int columns, int blocks, int small_jump,
                int large_jump, std::uint8_t* const* sum);
  /// Least cost of each column, both ways.
  void (*choose)(const std::uint8_t* sum, int columns, int blocks, double uniqueness_percent,
                 const RowChoice& choice);

  // --- correlation refinement; half is 1 .. kLargestHalf_px ---

  /// Mean of the values in columns x-half .. x+half that lie within `limit` of the centre, or whose
  /// mean with the value opposite does so by half (steep ground). Values are readable from -half to
  /// width - 1 + half.
  void (*smooth_along)(const float* values, int half, int width, float limit, float* out);
  /// The same over rows[0 .. 2 half], rows[half] being the centre; kept within max_shift of start.
  void (*smooth_down)(const float* const* rows, int half, int width, float limit,
                      const float* start, float max_shift, float* out);
  /// Coefficients of the cubic B-spline through a row. Values are readable kSplineReach_px further
  /// on both sides.
  void (*spline)(const float* values, int width, float* coefficients);
  /// The right picture at x - d(x), from its spline coefficients. 0 where known is 0.
  void (*warp)(const float* coefficients, const float* disparity, const float* known, int width,
               float* warped);
  /// columns[x] += a[x] b[x] of the row that enters, -= that of the row that leaves.
  void (*slide)(const float* enter_a, const float* enter_b, const float* leave_a,
                const float* leave_b, int width, float* columns);
  /// out[x] = columns[x] + .. + columns[x + 2 half].
  void (*sum_along)(const float* columns, int half, int width, float* out);
  void (*fit)(const FitSums& sums, const FitLimits& limits, int width, const RowFit& fit);
  void (*finish)(const RowFit& fit, int width, const RowFinish& row);
};

inline constexpr int kLargestHalf_px = 10;  ///< of the refinement's window

/// Runs on every x86-64.
const StereoLoops& PortableLoops();
/// Null where the processor has no AVX2.
const StereoLoops* Avx2Loops();
const StereoLoops& FastestLoops();

}  // namespace palace
