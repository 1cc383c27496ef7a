#include "engine/slad/sites/verdict_image.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace palace {
namespace {

constexpr int kDepthReach_blocks = 2;

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

/// Heights between which the map's measured ground lies; empty (low above high) without any.
struct HeightSpan {
  double low_m = HUGE_VAL, high_m = -HUGE_VAL;
};

HeightSpan SpanOf(const ElevationMap& map) {
  HeightSpan span;
  for (const float height : map.height_m.cells()) {
    if (std::isfinite(height)) {
      span.low_m = std::min(span.low_m, static_cast<double>(height));
      span.high_m = std::max(span.high_m, static_cast<double>(height));
    }
  }
  return span;
}

/// The first cell whose ground reaches up to the ray, in steps of at most a cell from the highest
/// ground down to the lowest; nothing where the ray meets no known ground.
std::optional<Cell> FirstHit(const ElevationMap& map, const HeightSpan& span,
                             const Eigen::Vector3d& p_WC, const Eigen::Vector3d& ray_W) {
  constexpr int kMostSteps = 200;
  if (!(ray_W.z() > 1e-3) || !(span.low_m <= span.high_m)) {
    return std::nullopt;
  }
  const double nearest = std::max(0.0, (-span.high_m - p_WC.z()) / ray_W.z());
  const double farthest = (-span.low_m - p_WC.z()) / ray_W.z();
  const double level_m = (farthest - nearest) * ray_W.head<2>().norm();
  const int steps = static_cast<int>(
      std::clamp(std::ceil(level_m / map.geometry.cell_m), 1.0, double(kMostSteps)));
  for (int k = 0; k <= steps && farthest >= nearest; ++k) {
    const Eigen::Vector3d p_W = p_WC + (nearest + (farthest - nearest) * k / steps) * ray_W;
    const auto cell = map.geometry.CellFromPoint(p_W.x(), p_W.y());
    if (cell && static_cast<double>(map.height_m.at(*cell)) >= -p_W.z() - 1e-6) {
      return cell;
    }
  }
  return std::nullopt;
}

}  // namespace

ImageU8 VerdictImage(const RangeMap& range, const ElevationMap& map, const HazardMaps& hazards,
                     int divisor) {
  PALACE_CHECK(divisor >= 1, divisor);
  PALACE_CHECK(map.geometry == hazards.geometry);
  PALACE_CHECK(range.pose.has_value());
  const PinholeCamera& camera = range.camera;
  const RigidTransform& X_WC = range.pose->X_WC;
  const HeightSpan span = SpanOf(map);
  ImageU8 verdict(range.depth_m.width() / divisor, range.depth_m.height() / divisor, 0);
  for (int v = 0; v < verdict.height(); ++v) {
    for (int u = 0; u < verdict.width(); ++u) {
      const int x = u * divisor + divisor / 2, y = v * divisor + divisor / 2;
      const Eigen::Vector3d ray_C((x - camera.cx_px) / camera.fx_px,
                                  (y - camera.cy_px) / camera.fy_px, 1);
      const float depth = NearestDepth(range.depth_m, x, y, kDepthReach_blocks * divisor);
      std::optional<Cell> cell;
      if (depth > 0) {
        const Eigen::Vector3d p_W = X_WC * (static_cast<double>(depth) * ray_C);
        cell = hazards.geometry.CellFromPoint(p_W.x(), p_W.y());
      } else {
        cell = FirstHit(map, span, X_WC.p, X_WC.R * ray_C);
      }
      if (!cell) {
        continue;
      }
      verdict.at(u, v) = static_cast<std::uint8_t>(hazards.ground.at(*cell));
    }
  }
  return verdict;
}

}  // namespace palace
