// Exact LMedS over 3x3 samples, then least squares on the inliers (thesis 4.3.2, erratum E24).
#include <algorithm>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/plane_fit.h"

namespace palace {
namespace {

/// Heights with a rim of unknown ones, so that windows at the rim are windows like any other.
class RimmedHeights {
 public:
  RimmedHeights(const GridF& height_m, int rim)
      : rim_(rim),
        grid_(height_m.rows() + 2 * rim, height_m.cols() + 2 * rim + kLaneSlack, kUnknownValue) {
    for (int r = 0; r < height_m.rows(); ++r) {
      std::copy_n(height_m.row(r), height_m.cols(), grid_.row(r + rim) + rim);
    }
  }
  /// Column 0 of a row; readable rim columns before it and kLaneSlack behind the far rim.
  const float* row(int r) const { return grid_.row(r + rim_) + rim_; }

 private:
  int rim_;
  GridF grid_;
};

}  // namespace

PlaneMaps FitThesisPlanes(const GridF& height_m, double cell_m, int stride,
                          const SladLoops* loops) {
  PALACE_CHECK(cell_m > 0 && stride >= 1, cell_m, stride);
  const int rows = height_m.rows(), cols = height_m.cols();
  PlaneMaps maps{GridF(rows, cols), GridF(rows, cols), GridF(rows, cols), GridF(rows, cols)};
  if (height_m.empty()) {
    return maps;
  }
  const SladLoops& fit = loops ? *loops : FastestSladLoops();
  const RimmedHeights heights(height_m, stride);
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int r = range.start; r < range.end; ++r) {
      const float* const window[] = {heights.row(r - stride), heights.row(r),
                                     heights.row(r + stride)};
      fit.fit_planes(window, stride, static_cast<float>(cell_m * stride), cols,
                     {maps.height_m.row(r), maps.residual_m.row(r), maps.north_gradient.row(r),
                      maps.east_gradient.row(r)});
    }
  });
  return maps;
}

}  // namespace palace
