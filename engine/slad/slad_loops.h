// Inner loops of the hazard maps: compiled once for every x86-64 and once for AVX2, chosen at run
// time. Both are made from the same source (lmeds_loops.h, verdict_loops.h) with uncontracted
// floats, so they give the same bits.
#pragma once

namespace palace {

/// Inliers of a plane: rounding must not reject points of an exact plane.
inline constexpr float kLeastThreshold_m = 1e-3F;
/// With fewer samples every triple has a median residual of 0: least squares over all of them.
inline constexpr float kLeastForMedian = 6;
/// Rows of heights must be readable so many floats beyond the last window.
inline constexpr int kLaneSlack = 8;

/// One row of fitted planes; arrays of the row's length, NaN where no plane is spanned.
struct PlaneRow {
  float* height_m;
  float* residual_m;  ///< height of the cell less that of the plane
  float* north_gradient;
  float* east_gradient;
};

struct SladLoops {
  /// Exact LMedS, then least squares, around each of `count` cells. rows: the heights `stride` rows
  /// to the north, of the row itself and to the south, at column 0; readable from -stride to
  /// count - 1 + stride + kLaneSlack, NaN where unknown.
  void (*fit_planes)(const float* const* rows, int stride, float spacing_m, int count,
                     const PlaneRow& out);
};

/// Runs on every x86-64.
const SladLoops& PortableSladLoops();
/// Null where the processor has no AVX2.
const SladLoops* Avx2SladLoops();
const SladLoops& FastestSladLoops();

}  // namespace palace
