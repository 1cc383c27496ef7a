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

double MedianDepth(const TerrainPoints& points, const RigidTransform& X_WC) {
  std::vector<double> depths;
  for (const TerrainPoint& p : points) {
    const Eigen::Vector3d p_W(p.north_m, p.east_m, -p.height_m);
    depths.push_back(X_WC.R.col(2).dot(p_W - X_WC.p));
  }
  return UpperMedian(depths);
}

/// Cells along one side, as it had `now`; 0: it had none yet.
int CellsAlong(double extent_m, double cell_m, int least, int now) {
  const double needed = std::min(extent_m / cell_m, kWidestView * least);
  const int held = kStep_cells * static_cast<int>(std::ceil(needed / kStep_cells));
  const int most =
      std::min(static_cast<int>(kWidestView) * least, std::max(least, GridSettings::kMostCells));
  const int wanted = std::clamp(held, least, most);
  return wanted < now && needed > kWellInside * now ? now : wanted;
}

}  // namespace

SladSettings ViewCell::Fit(const RangeMap& range, const SladSettings& settings) {
  const bool follows =
      settings.mode == SladMode::kModern && settings.grid.bounds == BoundsMode::kData;
  const TerrainPoints points = follows ? PointsFromRange(range, kStride_px) : TerrainPoints{};
  if (points.empty()) {
    *this = {};
    return settings;
  }
  const PinholeCamera& camera = range.camera;
  const double view_m = MedianDepth(points, range.pose->X_WC) *
                        std::max(camera.width / camera.fx_px, camera.height / camera.fy_px);
  const double map_m = std::min(settings.grid.rows, settings.grid.cols) * settings.grid.cell_m;
  while (factor_ < kMostFactor && view_m > kWidestView * map_m * factor_) {
    factor_ *= 2;
  }
  while (factor_ > 1 && view_m < kWellInside * kWidestView * map_m * (factor_ / 2)) {
    factor_ /= 2;
  }
  SladSettings fitted = settings;
  fitted.grid.cell_m *= factor_;
  const GroundBounds seen = BoundsOfData(points);
  rows_ = CellsAlong(seen.north_max_m - seen.north_min_m, fitted.grid.cell_m, settings.grid.rows,
                     rows_);
  cols_ =
      CellsAlong(seen.east_max_m - seen.east_min_m, fitted.grid.cell_m, settings.grid.cols, cols_);
  fitted.grid.rows = rows_;
  fitted.grid.cols = cols_;
  return fitted;
}

}  // namespace palace
