#include "engine/slad/terrain/view_cell.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/median.h"

namespace palace {
namespace {

constexpr int kDepthStride_px = 16;
constexpr int kMostFactor = 16;
constexpr double kWidestView = 2;  // views up to twice the map's width keep the cell
// Back only well inside, so that a view near the border does not toggle the map.
constexpr double kWellInside = 0.8;

/// 0 without a point.
double MedianDepth(const RangeMap& range) {
  std::vector<float> depths;
  for (int y = 0; y < range.depth_m.height(); y += kDepthStride_px) {
    for (int x = 0; x < range.depth_m.width(); x += kDepthStride_px) {
      if (std::isfinite(range.depth_m.at(x, y))) {
        depths.push_back(range.depth_m.at(x, y));
      }
    }
  }
  return depths.empty() ? 0 : static_cast<double>(UpperMedian(depths));
}

}  // namespace

SladSettings ViewCell::Fit(const RangeMap& range, const SladSettings& settings) {
  const double depth_m = MedianDepth(range);
  if (depth_m == 0 || settings.mode != SladMode::kModern ||
      settings.grid.bounds != BoundsMode::kData) {
    factor_ = 1;
    return settings;
  }
  const PinholeCamera& camera = range.camera;
  const double view_m =
      depth_m * std::max(camera.width / camera.fx_px, camera.height / camera.fy_px);
  const double map_m = std::min(settings.grid.rows, settings.grid.cols) * settings.grid.cell_m;
  while (factor_ < kMostFactor && view_m > kWidestView * map_m * factor_) {
    factor_ *= 2;
  }
  while (factor_ > 1 && view_m < kWellInside * kWidestView * map_m * (factor_ / 2)) {
    factor_ /= 2;
  }
  SladSettings fitted = settings;
  fitted.grid.cell_m *= factor_;
  return fitted;
}

}  // namespace palace
