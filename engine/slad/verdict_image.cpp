#include "engine/slad/verdict_image.h"

#include <cmath>

namespace palace {
namespace {

/// Depth at the pixel or at the nearest measured one on growing squares around it; NaN when none.
float NearestDepth(const ImageF& depth, int x, int y, int reach) {
  for (int d = 0; d <= reach; ++d) {
    for (int dy = -d; dy <= d; ++dy) {
      // Inside the square only its left and right sides are new.
      const int step = std::abs(dy) == d || d == 0 ? 1 : 2 * d;
      for (int dx = -d; dx <= d; dx += step) {
        if (depth.Contains(x + dx, y + dy) && std::isfinite(depth.at(x + dx, y + dy))) {
          return depth.at(x + dx, y + dy);
        }
      }
    }
  }
  return kUnknownValue;
}

}  // namespace

ImageU8 VerdictImage(const RangeMap& range, const RigidTransform& X_WC, const HazardMaps& hazards,
                     int divisor) {
  PALACE_CHECK(divisor >= 1, divisor);
  const PinholeCamera& camera = range.camera;
  ImageU8 verdict(range.depth_m.width() / divisor, range.depth_m.height() / divisor, 0);
  for (int v = 0; v < verdict.height(); ++v) {
    for (int u = 0; u < verdict.width(); ++u) {
      const int x = u * divisor + divisor / 2, y = v * divisor + divisor / 2;
      const float depth = NearestDepth(range.depth_m, x, y, 2 * divisor);
      if (!(depth > 0)) {
        continue;
      }
      const Eigen::Vector3d p_W = X_WC * (static_cast<double>(depth) *
                                          Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                                          (y - camera.cy_px) / camera.fy_px, 1));
      const auto cell = hazards.geometry.CellFromPoint(p_W.x(), p_W.y());
      if (!cell) {
        continue;
      }
      const unsigned reasons = hazards.reasons.at(*cell);
      const bool over = (reasons & ~unsigned{kHazardUnknown}) != 0;
      const bool unknown = (reasons & kHazardUnknown) != 0;
      verdict.at(u, v) = unknown ? 0 : over ? 2 : 1;
    }
  }
  return verdict;
}

}  // namespace palace
