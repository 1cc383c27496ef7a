#include "engine/slad/terrain/view_cell.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/median.h"
#include "engine/slad/terrain/terrain_points.h"

namespace palace {
namespace {

constexpr int kStride_px = 8;
constexpr int kMostFactor = 16;
constexpr double kWidestView = 2;  // views up to twice the map's width keep the cell
// Back only well inside, so that a view near the border does not toggle the map.
constexpr double kWellInside = 0.8;
constexpr int kStep_cells = 20;
constexpr int kMostCells = 4096;  // along a side, as in the settings

/// Some points of the view, and the median of their depths.
struct Sample {
  TerrainPoints points{};
  double depth_m = 0;
};

Sample SampleOf(const RangeMap& range) {
  Sample sample;
  std::vector<float> depths;
  const PinholeCamera& camera = range.camera;
  for (int y = 0; y < range.depth_m.height(); y += kStride_px) {
    for (int x = 0; x < range.depth_m.width(); x += kStride_px) {
      const float depth_m = range.depth_m.at(x, y);
      if (!std::isfinite(depth_m)) {
        continue;
      }
      depths.push_back(depth_m);
      const Eigen::Vector3d p_W =
          range.pose->X_WC *
          (static_cast<double>(depth_m) * Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                                          (y - camera.cy_px) / camera.fy_px, 1));
      sample.points.push_back({p_W.x(), p_W.y(), HeightFromDown(p_W.z()), 0});
    }
  }
  sample.depth_m = depths.empty() ? 0 : static_cast<double>(UpperMedian(depths));
  return sample;
}

/// Cells along one side, as it had `now`; 0: it had none yet.
int CellsAlong(double extent_m, double cell_m, int least, int now) {
  const double needed = std::min(extent_m / cell_m, kWidestView * least);
  const int held = kStep_cells * static_cast<int>(std::ceil(needed / kStep_cells));
  const int most = std::min(static_cast<int>(kWidestView) * least, std::max(least, kMostCells));
  const int wanted = std::clamp(held, least, most);
  return wanted < now && needed > kWellInside * now ? now : wanted;
}

}  // namespace

SladSettings ViewCell::Fit(const RangeMap& range, const SladSettings& settings) {
  const bool follows =
      settings.mode == SladMode::kModern && settings.grid.bounds == BoundsMode::kData;
  const Sample sample = follows ? SampleOf(range) : Sample{};
  if (sample.points.empty()) {
    *this = {};
    return settings;
  }
  const PinholeCamera& camera = range.camera;
  const double view_m =
      sample.depth_m * std::max(camera.width / camera.fx_px, camera.height / camera.fy_px);
  const double map_m = std::min(settings.grid.rows, settings.grid.cols) * settings.grid.cell_m;
  while (factor_ < kMostFactor && view_m > kWidestView * map_m * factor_) {
    factor_ *= 2;
  }
  while (factor_ > 1 && view_m < kWellInside * kWidestView * map_m * (factor_ / 2)) {
    factor_ /= 2;
  }
  SladSettings fitted = settings;
  fitted.grid.cell_m *= factor_;
  const GroundBounds seen = BoundsOfData(sample.points);
  rows_ = CellsAlong(seen.north_max_m - seen.north_min_m, fitted.grid.cell_m, settings.grid.rows,
                     rows_);
  cols_ =
      CellsAlong(seen.east_max_m - seen.east_min_m, fitted.grid.cell_m, settings.grid.cols, cols_);
  fitted.grid.rows = rows_;
  fitted.grid.cols = cols_;
  return fitted;
}

}  // namespace palace
