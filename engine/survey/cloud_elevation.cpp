#include "engine/survey/cloud_elevation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/core/text.h"
#include "engine/geodata/geo_tiff.h"
#include "engine/slad/terrain/elevation_map_builder.h"
#include "engine/slad/terrain/hole_filling.h"
#include "engine/survey/cloud_doubts.h"

namespace palace {
namespace {

/// Points this far below the highest of their cell belong to the same surface.
constexpr double kSurfaceDepth_m = 0.3;
/// Where points are scattered at random, three a cell leave one cell in twenty empty.
constexpr double kPointsACell = 3;
constexpr double kLowestLand_m = -450, kHighestLand_m = 9000;
/// What may be empty by chance where a lander would stand: then more than a third of all places are
/// without. Cells grow by steps until it is so, or have twice the side.
constexpr double kGapsALander = 1;
constexpr double kGapStep = 1.1, kGapMost = 2;
/// Surveys round their coordinates, so that many points would lie on lines between cells and belong
/// to either, depending on which side one counts from. The grid starts this share of a cell
/// earlier.
constexpr double kOffLine = 1e-3;

/// Of the points at the top of one cell, depths below the highest.
struct TopSums {
  float depth = 0;
  float square = 0;
  std::uint32_t count = 0;
};

ElevationMap MapOfTops(const CloudPoints& points, const GridGeometry& geometry) {
  const int rows = geometry.rows, cols = geometry.cols;
  ElevationMap map{{},
                   geometry,
                   GridF(rows, cols, kUnknownValue),
                   GridF(rows, cols, kUnknownValue),
                   Grid<std::uint16_t>(rows, cols, 0),
                   Grid<CellState>(rows, cols, CellState::kUnknown)};
  const auto each = [&](auto work) {
    for (const Eigen::Vector3d& p : points) {
      if (const auto cell = geometry.CellFromPoint(p.x(), p.y())) {
        work(*cell, p.z());
      }
    }
  };
  each([&](Cell cell, double z) {
    float& high = map.height_m.at(cell);
    high = std::isnan(high) ? static_cast<float>(z) : std::max(high, static_cast<float>(z));
  });
  Grid<TopSums> tops(rows, cols);
  each([&](Cell cell, double z) {
    const double depth = std::max(0.0, static_cast<double>(map.height_m.at(cell)) - z);
    if (depth <= kSurfaceDepth_m) {
      TopSums& top = tops.at(cell);
      top.depth += static_cast<float>(depth);
      top.square += static_cast<float>(depth * depth);
      ++top.count;
    }
  });
  const double slope_spread_m2 = std::pow(kSlopeSpread_cells * geometry.cell_m, 2);
  for (std::size_t i = 0; i < tops.cells().size(); ++i) {
    const TopSums& top = tops.cells()[i];
    if (top.count == 0) {
      continue;
    }
    const double n = top.count, mean = static_cast<double>(top.depth) / n;
    const double bessel = n > 1 ? n / (n - 1) : 1;
    const double spread = (static_cast<double>(top.square) / n - mean * mean) * bessel;
    map.height_m.cells()[i] -= static_cast<float>(mean);
    map.variance_m2.cells()[i] =
        static_cast<float>(std::max(spread - slope_spread_m2, kLeastPointVariance_m2) / n);
    map.frame_count.cells()[i] = 1;
    map.state.cells()[i] = CellState::kMeasured;
  }
  return map;
}

/// Rows and columns that hold all points from `low` on; as floating point, for there may be many.
Eigen::Vector2d CellsOf(const Eigen::Vector2d& extent, double cell_m) {
  const auto cells = [&](double metres) { return std::floor(metres / cell_m + kOffLine) + 1; };
  return {cells(extent.x()), cells(extent.y())};
}

GridGeometry GeometryOf(const Eigen::Vector2d& low, const Eigen::Vector2d& extent, double cell_m) {
  const Eigen::Vector2d cells = CellsOf(extent, cell_m);
  GridGeometry g;
  g.cell_m = cell_m;
  g.rows = static_cast<int>(cells.x());
  g.cols = static_cast<int>(cells.y());
  g.north_min_m = low.x() - kOffLine * cell_m;
  g.east_min_m = low.y() - kOffLine * cell_m;
  return g;
}

/// Enlarges the cell, with a warning, until the grid covers the extent.
void CoverExtent(double north_m, double east_m, SladSettings& slad,
                 std::vector<std::string>& warnings) {
  if (slad.mode == SladMode::kThesis || slad.grid.bounds != BoundsMode::kData) {
    return;
  }
  const double needed_m = std::max(north_m / slad.grid.rows, east_m / slad.grid.cols);
  if (needed_m > slad.grid.cell_m) {
    warnings.push_back(
        WithNumbers("cell enlarged from %.3g m to %.3g m so that the map covers the data; "
                    "set slad.grid_rows and slad.grid_cols, or the bounds, for finer cells",
                    slad.grid.cell_m, needed_m));
    slad.grid.cell_m = needed_m;
  }
}

void AddDoubt(const std::string& doubt, std::vector<std::string>& warnings) {
  if (!doubt.empty()) {
    warnings.push_back(doubt);
  }
}

/// Enlarges the cell up to `most` times, with a warning, while single cells are empty by chance
/// wherever a lander would stand: heights are never made up, so each of them forbids its
/// surroundings.
GridGeometry CloseSingleGaps(const CloudPoints& points, const GridGeometry& begun,
                             const Eigen::Vector2d& extent, double most, const Lander& lander,
                             std::vector<std::string>& warnings) {
  const SingleGaps first = CountSingleGaps(points, begun);
  const Eigen::Vector2d low(begun.north_min_m + kOffLine * begun.cell_m,
                            begun.east_min_m + kOffLine * begun.cell_m);
  GridGeometry g = begun;
  SingleGaps left = first;
  while (left.ALander(lander, g.cell_m) > kGapsALander &&
         g.cell_m * kGapStep <= most * begun.cell_m) {
    g = GeometryOf(low, extent, g.cell_m * kGapStep);
    left = CountSingleGaps(points, g);
  }
  if (g.cell_m > begun.cell_m) {
    warnings.push_back(
        WithNumbers("cell enlarged from %.3g m to %.3g m: ", begun.cell_m, g.cell_m) +
        WithNumbers("of the smaller ones %.0f of %.0f lie single without a point among others, and "
                    "unknown ground forbids what is round it; --cell-m overrides",
                    first.gaps, first.cells));
  }
  if (left.ALander(lander, g.cell_m) > kGapsALander) {
    warnings.push_back(
        WithNumbers("%.0f of %.0f cells lie single without a point among others", left.gaps,
                    left.cells) +
        WithNumbers(", %.1f where a lander would stand: unknown ground, which forbids what is "
                    "within %.3g m; use a larger --cell-m, or more points",
                    left.ALander(lander, g.cell_m), lander.clear_radius_m()));
  }
  return g;
}

}  // namespace

bool IsOnEarth(double height_m) { return height_m > kLowestLand_m && height_m < kHighestLand_m; }

Result<ElevationMap> MapOfCloud(const std::vector<Eigen::Vector3d>& survey,
                                std::optional<double> cell_m, SladSettings slad,
                                std::vector<std::string>& warnings) {
  CloudPoints points;
  points.reserve(survey.size());
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL), high = -low;
  for (const Eigen::Vector3d& p : survey) {
    if (p.allFinite() && IsOnEarth(p.z()) && p.head<2>().cwiseAbs().maxCoeff() < kFarthestPlace_m) {
      points.emplace_back(p.y(), p.x(), p.z());
      low = low.cwiseMin(points.back().head<2>());
      high = high.cwiseMax(points.back().head<2>());
    }
  }
  if (points.empty()) {
    return InvalidError("no point is finite and on Earth");
  }
  if (points.size() < survey.size()) {
    warnings.push_back(WithNumbers(
        "%.0f of %.0f points are not finite, below -450 m or above 9000 m, or more than "
        "130 000 km from the origin: left out",
        double(survey.size() - points.size()), double(survey.size())));
  }
  slad.grid.cell_m = cell_m.value_or(slad.grid.cell_m);
  if (slad.grid.bounds != BoundsMode::kData || slad.mode == SladMode::kThesis) {
    for (Eigen::Vector3d& p : points) {
      p.z() = -p.z();
    }
    return ElevationFromPoints(points, nullptr, slad, {});
  }
  const Eigen::Vector2d extent = high - low;
  AddDoubt(DoubtOfExtent(points, extent, slad.lander), warnings);
  if (!cell_m) {
    const double wanted_m = slad.grid.cell_m;
    CoverExtent(extent.x(), extent.y(), slad, warnings);
    if (slad.grid.cell_m > wanted_m) {
      AddDoubt(DoubtOfFarPoints(points, extent), warnings);
    }
    const double spacing_m =
        std::sqrt(kPointsACell * extent.x() * extent.y() / double(points.size()));
    if (spacing_m > slad.grid.cell_m) {
      warnings.push_back(
          WithNumbers("cell of %.3g m enlarged to %.3g m, for %.0f points a cell: of fewer, were "
                      "they scattered at random, too many cells would have none",
                      slad.grid.cell_m, spacing_m, kPointsACell));
      slad.grid.cell_m = spacing_m;
    }
  }
  const Eigen::Vector2d cells = CellsOf(extent, slad.grid.cell_m);
  if (!(cells.maxCoeff() <= GridSettings::kMostCells)) {
    const std::string far = DoubtOfFarPoints(points, extent);
    return UsageError(
        WithNumbers("%.5g x %.5g cells needed, the limit is %.0f a side; use a larger "
                    "--cell-m",
                    cells.x(), cells.y(), GridSettings::kMostCells) +
        (far.empty() ? "" : ". " + far));
  }
  const GridGeometry g = CloseSingleGaps(points, GeometryOf(low, extent, slad.grid.cell_m), extent,
                                         cell_m.has_value() ? 1 : kGapMost, slad.lander, warnings);
  ElevationMap map = MapOfTops(points, g);
  FillHoles(map, slad.grid.data_size_cells, slad.grid.border_size_cells);
  return map;
}

}  // namespace palace
