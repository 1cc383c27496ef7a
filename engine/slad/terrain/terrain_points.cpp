#include "engine/slad/terrain/terrain_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/slad/terrain/elevation_map_builder.h"

namespace palace {
namespace {

/// Percentiles need no more than this many points; taken at even spacing, so deterministic.
constexpr std::size_t kSampleSize = 20000;
/// Share of the points left out on each side of the bounds: stray matches.
constexpr double kBoundsShare = 0.01;
constexpr double kFarthestView = 2;  // in mean ranges
/// Mean variance above which points state their noise; a survey's do not.
constexpr double kStatedVariance_m2 = 4e-6;
constexpr double kSaidVariance = 2;  // points err by somewhat more than they say

template <typename Get>
std::vector<double> SampleOf(const TerrainPoints& points, Get get) {
  std::vector<double> sample;
  const std::size_t step = points.size() / kSampleSize + 1;
  for (std::size_t i = 0; i < points.size(); i += step) {
    sample.push_back(get(points[i]));
  }
  return sample;
}

double Percentile(std::vector<double>& sample, double share) {
  if (sample.empty()) {
    return 0;
  }
  const auto at = static_cast<std::ptrdiff_t>(std::lround(share * double(sample.size() - 1)));
  std::nth_element(sample.begin(), sample.begin() + at, sample.end());
  return sample[static_cast<std::size_t>(at)];
}

double MedianHeight(const TerrainPoints& points) {
  auto sample = SampleOf(points, [](const TerrainPoint& p) { return p.height_m; });
  return Percentile(sample, 0.5);
}

struct CellSums {
  double weight = 0;
  double height = 0;  ///< weighted, above the reference
  double square = 0;  ///< weighted
  int count = 0;
};

}  // namespace

TerrainPoints PointsFromRange(const RangeMap& range, int stride_px) {
  PALACE_CHECK(range.pose.has_value());
  const RigidTransform& X_WC = range.pose->X_WC;
  TerrainPoints points;
  const PinholeCamera& camera = range.camera;
  points.reserve(range.depth_m.pixels().size() / static_cast<std::size_t>(stride_px * stride_px));
  for (int y = 0; y < range.depth_m.height(); y += stride_px) {
    const float* depth = range.depth_m.row(y);
    const float* sigma = range.depth_sigma_m.empty() ? nullptr : range.depth_sigma_m.row(y);
    const Eigen::Vector3d row_W = X_WC.R * Eigen::Vector3d(-camera.cx_px / camera.fx_px,
                                                           (y - camera.cy_px) / camera.fy_px, 1);
    const Eigen::Vector3d step_W = X_WC.R.col(0) / camera.fx_px;
    for (int x = 0; x < range.depth_m.width(); x += stride_px) {
      const double z = static_cast<double>(depth[x]);
      if (!(z > 0) || !std::isfinite(z)) {
        continue;
      }
      const Eigen::Vector3d ray_W = row_W + x * step_W;
      const double sigma_z = sigma == nullptr ? 0.0 : static_cast<double>(sigma[x]);
      if (!std::isfinite(sigma_z)) {
        continue;
      }
      const Eigen::Vector3d p_W = X_WC.p + z * ray_W;
      points.push_back(
          {p_W.x(), p_W.y(), HeightFromDown(p_W.z()), ray_W.z() * ray_W.z() * sigma_z * sigma_z});
    }
  }
  return points;
}

GroundBounds BoundsOfData(const TerrainPoints& points) {
  auto north = SampleOf(points, [](const TerrainPoint& p) { return p.north_m; });
  auto east = SampleOf(points, [](const TerrainPoint& p) { return p.east_m; });
  GroundBounds bounds;
  bounds.north_min_m = Percentile(north, kBoundsShare);
  bounds.north_max_m = Percentile(north, 1 - kBoundsShare);
  bounds.east_min_m = Percentile(east, kBoundsShare);
  bounds.east_max_m = Percentile(east, 1 - kBoundsShare);
  return bounds;
}

GroundBounds BoundsOfView(const TerrainPoints& points, const RangeMap& view) {
  const PinholeCamera& camera = view.camera;
  const RigidTransform& X_WC = view.pose->X_WC;
  double range_sum = 0;
  for (const TerrainPoint& p : points) {
    range_sum += (Eigen::Vector3d(p.north_m, p.east_m, -p.height_m) - X_WC.p).norm();
  }
  const double farthest_m = kFarthestView * range_sum / std::max<double>(1, double(points.size()));
  const double down_m = -MedianHeight(points) - X_WC.p.z();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  GroundBounds bounds{kFar, -kFar, kFar, -kFar};
  for (const double x : {-0.5, camera.width - 0.5}) {
    for (const double y : {-0.5, camera.height - 0.5}) {
      const Eigen::Vector3d ray_W = X_WC.R * Eigen::Vector3d((x - camera.cx_px) / camera.fx_px,
                                                             (y - camera.cy_px) / camera.fy_px, 1)
                                                 .normalized();
      const double range_m =
          ray_W.z() * farthest_m > down_m && ray_W.z() > 0 ? down_m / ray_W.z() : farthest_m;
      const Eigen::Vector3d p_W = X_WC.p + range_m * ray_W;
      bounds.north_min_m = std::min(bounds.north_min_m, p_W.x());
      bounds.north_max_m = std::max(bounds.north_max_m, p_W.x());
      bounds.east_min_m = std::min(bounds.east_min_m, p_W.y());
      bounds.east_max_m = std::max(bounds.east_max_m, p_W.y());
    }
  }
  return bounds;
}

GroundBounds ChooseBounds(const TerrainPoints& points, const SladSettings& settings,
                          const RangeMap* view) {
  if (settings.grid.bounds == BoundsMode::kFieldOfView && view != nullptr && !points.empty()) {
    return BoundsOfView(points, *view);
  }
  if (settings.grid.bounds != BoundsMode::kGiven) {
    return BoundsOfData(points);
  }
  auto north = SampleOf(points, [](const TerrainPoint& p) { return p.north_m; });
  auto east = SampleOf(points, [](const TerrainPoint& p) { return p.east_m; });
  const double north_m = Percentile(north, 0.5);
  const double east_m = Percentile(east, 0.5);
  const auto [x_min, x_max] = std::minmax(settings.grid.x_min_m, settings.grid.x_max_m);
  const auto [y_min, y_max] = std::minmax(settings.grid.y_min_m, settings.grid.y_max_m);
  return {north_m + x_min, north_m + x_max, east_m + y_min, east_m + y_max};
}

GridGeometry LayOutGrid(const GroundBounds& bounds, const SladSettings& settings) {
  const double north_m = (bounds.north_min_m + bounds.north_max_m) / 2;
  const double east_m = (bounds.east_min_m + bounds.east_max_m) / 2;
  const double height_m = bounds.north_max_m - bounds.north_min_m;
  const double width_m = bounds.east_max_m - bounds.east_min_m;
  GridGeometry grid;
  grid.rows = settings.grid.rows;
  grid.cols = settings.grid.cols;
  if (settings.mode == SladMode::kThesis) {
    // A hair wider, so that the points on the bounds themselves fall inside.
    grid.cell_m = std::max({height_m / grid.rows, width_m / grid.cols, 1e-3}) * (1 + 1e-9);
    grid.north_min_m = north_m - grid.rows * grid.cell_m / 2;
    grid.east_min_m = east_m - grid.cols * grid.cell_m / 2;
    return grid;
  }
  grid.cell_m = settings.grid.cell_m;
  if (settings.grid.bounds == BoundsMode::kGiven) {
    const auto cells = [&](double extent_m, int limit) {
      return std::clamp(static_cast<int>(std::lround(std::min(extent_m / grid.cell_m, 1e6))), 1,
                        limit);
    };
    grid.rows = cells(height_m, grid.rows);
    grid.cols = cells(width_m, grid.cols);
  }
  const auto snap = [&](double corner_m) {
    return std::round(corner_m / grid.cell_m) * grid.cell_m;
  };
  grid.north_min_m = snap(north_m - grid.rows * grid.cell_m / 2);
  grid.east_min_m = snap(east_m - grid.cols * grid.cell_m / 2);
  return grid;
}

ElevationMap AccumulateCells(const TerrainPoints& points, const GridGeometry& geometry,
                             SladMode mode, double correlated_points, Timestamp time) {
  const int rows = geometry.rows, cols = geometry.cols;
  ElevationMap map{time,
                   geometry,
                   GridF(rows, cols, kUnknownValue),
                   GridF(rows, cols, kUnknownValue),
                   Grid<std::uint16_t>(rows, cols, 0),
                   Grid<CellState>(rows, cols, CellState::kUnknown)};
  if (mode != SladMode::kThesis) {
    map.measured_m = GridF(rows, cols, kUnknownValue);
  }
  const double reference_m = MedianHeight(points);
  Grid<CellSums> sums(rows, cols);
  for (const TerrainPoint& p : points) {
    const auto cell = geometry.CellFromPoint(p.north_m, p.east_m);
    if (!cell) {
      continue;
    }
    CellSums& s = sums.at(*cell);
    // Thesis mode: every point counts alike.
    const double w =
        mode == SladMode::kThesis ? 1.0 : 1.0 / (p.variance_m2 + kLeastPointVariance_m2);
    const double z = p.height_m - reference_m;
    s.weight += w;
    s.height += w * z;
    s.square += w * z * z;
    ++s.count;
  }
  const double slope_spread_m2 = std::pow(kSlopeSpread_cells * geometry.cell_m, 2);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const CellSums& s = sums.at(r, c);
      if (s.count == 0) {
        continue;
      }
      const double mean = s.height / s.weight;
      const double bessel = s.count > 1 ? s.count / (s.count - 1.0) : 1.0;
      const double spread = std::max(0.0, s.square / s.weight - mean * mean) * bessel;
      const bool stated = mode != SladMode::kThesis && s.count / s.weight > kStatedVariance_m2;
      const double predicted = stated ? s.count / s.weight : 0.0;
      // Spread beyond the points' own noise is relief inside the cell: its upper side counts.
      const double relief_m2 = spread - kSaidVariance * predicted - slope_spread_m2;
      const double relief_m = stated ? std::sqrt(std::max(0.0, relief_m2)) : 0.0;
      const double one_point =
          stated ? std::max({predicted, std::min(spread, kSaidVariance * predicted),
                             kLeastPointVariance_m2})
                 : std::max(spread - slope_spread_m2, kLeastPointVariance_m2);
      map.height_m.at(r, c) = static_cast<float>(mean + relief_m + reference_m);
      if (!map.measured_m.empty()) {
        map.measured_m.at(r, c) = static_cast<float>(mean + reference_m);
      }
      map.variance_m2.at(r, c) =
          static_cast<float>(one_point / std::max(1.0, s.count / correlated_points));
      map.frame_count.at(r, c) = 1;
      map.state.at(r, c) = CellState::kMeasured;
    }
  }
  return map;
}

}  // namespace palace
