#include "engine/slad/terrain/refused_pixels.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

bool IsKnown(const RangeMap& range, int x, int y) {
  const float depth_m = range.depth_m.at(x, y);
  return depth_m > 0 && std::isfinite(depth_m) &&
         (range.depth_sigma_m.empty() || std::isfinite(range.depth_sigma_m.at(x, y)));
}

}  // namespace

void CountPixels(const RangeMap& range, const GridGeometry& geometry, Grid<PixelCount>& counts) {
  PALACE_CHECK(range.pose.has_value());
  const PinholeCamera& camera = range.camera;
  const RigidTransform& X_WC = range.pose->X_WC;
  const Eigen::Vector3d step_W = X_WC.R.col(0) / camera.fx_px;
  for (int y = 0; y < range.depth_m.height(); ++y) {
    const Eigen::Vector3d row_W = X_WC.R * Eigen::Vector3d(-camera.cx_px / camera.fx_px,
                                                           (y - camera.cy_px) / camera.fy_px, 1);
    const auto count_of = [&](int x, float depth_m) -> PixelCount* {
      const Eigen::Vector3d p_WQ = X_WC.p + static_cast<double>(depth_m) * (row_W + x * step_W);
      const auto cell = geometry.CellFromPoint(p_WQ.x(), p_WQ.y());
      return cell ? &counts.at(*cell) : nullptr;
    };
    int last_known = -1;
    for (int x = 0; x < range.depth_m.width(); ++x) {
      if (!IsKnown(range, x, y)) {
        continue;
      }
      const float depth_m = range.depth_m.at(x, y);
      if (PixelCount* count = count_of(x, depth_m)) {
        count->known += 1;
      }
      for (int gap = last_known + 1; last_known >= 0 && gap < x; ++gap) {
        if (PixelCount* count = count_of(gap, std::max(depth_m, range.depth_m.at(last_known, y)))) {
          count->refused += 1;
        }
      }
      last_known = x;
    }
  }
}

}  // namespace palace
