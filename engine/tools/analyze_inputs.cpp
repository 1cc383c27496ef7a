#include "engine/tools/analyze_inputs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/camera/rectification.h"
#include "engine/camera/rig_file.h"
#include "engine/capture/picture_file.h"
#include "engine/core/time.h"
#include "engine/core/units.h"
#include "engine/slad/elevation_map_builder.h"
#include "engine/slad/hole_filling.h"
#include "engine/slad/terrain_points.h"
#include "engine/stereo/prefilter.h"
#include "engine/stereo/stereo.h"
#include "engine/tools/map_files.h"
#include "engine/tools/point_files.h"

namespace palace {
namespace {

constexpr double kTallestObject_m = 5;
constexpr int kMostCells = 4096;

class Stopwatch {
 public:
  StageTime Lap(const char* stage) {
    const double now = MonotonicSeconds();
    const StageTime time{stage, (now - last_) * 1e3};
    last_ = now;
    return time;
  }

 private:
  double last_ = MonotonicSeconds();
};

std::string Text(const char* format, double a, double b = 0, double c = 0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

/// Enlarges the cell until grid_rows x grid_cols cover the extent.
void CoverExtent(double north_m, double east_m, SladSettings& slad,
                 std::vector<std::string>& warnings) {
  if (slad.mode == SladMode::kThesis || slad.bounds != BoundsMode::kData) {
    return;
  }
  const double needed_m = std::max(north_m / slad.grid_rows, east_m / slad.grid_cols);
  if (needed_m > slad.cell_m) {
    warnings.push_back(
        Text("cell enlarged from %.3g m to %.3g m so that the map covers the data; "
             "set slad.grid_rows and slad.grid_cols, or the bounds, for finer cells",
             slad.cell_m, needed_m));
    slad.cell_m = needed_m;
  }
}

ElevationMap MapOfLayer(const MapLayer& layer) {
  const GridGeometry& g = layer.geometry;
  ElevationMap map{{},
                   g,
                   layer.cells,
                   GridF(g.rows, g.cols, kUnknownValue),
                   Grid<std::uint16_t>(g.rows, g.cols, 0),
                   Grid<CellState>(g.rows, g.cols, CellState::kUnknown)};
  for (std::size_t i = 0; i < layer.cells.cells().size(); ++i) {
    if (std::isfinite(layer.cells.cells()[i])) {
      map.variance_m2.cells()[i] = 1e-6F;  // a model states no noise
      map.frame_count.cells()[i] = 1;
      map.state.cells()[i] = CellState::kMeasured;
    } else {
      map.height_m.cells()[i] = kUnknownValue;
    }
  }
  return map;
}

/// Map over all points, survey coordinates being north and east of W.
Result<ElevationMap> MapOfPoints(const std::vector<Eigen::Vector3d>& survey,
                                 std::optional<double> cell_m, SladSettings slad,
                                 std::vector<std::string>& warnings) {
  std::vector<Eigen::Vector3d> p_W;
  p_W.reserve(survey.size());
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL), high = -low;
  for (const Eigen::Vector3d& p : survey) {
    if (p.allFinite()) {
      p_W.emplace_back(p.y(), p.x(), -p.z());
      low = low.cwiseMin(p_W.back().head<2>());
      high = high.cwiseMax(p_W.back().head<2>());
    }
  }
  if (p_W.empty()) {
    return InvalidError("the input has no finite point");
  }
  if (slad.bounds != BoundsMode::kData || slad.mode == SladMode::kThesis) {
    slad.cell_m = cell_m.value_or(slad.cell_m);
    return ElevationFromPoints(p_W, nullptr, slad, {});
  }
  const Eigen::Vector2d extent = high - low;
  if (cell_m) {
    slad.cell_m = *cell_m;
  } else {
    CoverExtent(extent.x(), extent.y(), slad, warnings);
    // Where points are scattered at random, three a cell leave one cell in twenty empty.
    const double spacing_m = std::sqrt(3 * extent.x() * extent.y() / double(p_W.size()));
    if (spacing_m > slad.cell_m) {
      warnings.push_back(Text("cell enlarged to %.3g m: the points are that sparse", spacing_m));
      slad.cell_m = spacing_m;
    }
  }
  GridGeometry g;
  g.cell_m = slad.cell_m;
  const auto cells = [&](double metres) { return std::floor(metres / g.cell_m) + 1; };
  if (!(std::max(cells(extent.x()), cells(extent.y())) <= kMostCells)) {
    return UsageError(
        Text("%.0f x %.0f cells needed, the limit is 4096 a side; use a larger "
             "--cell-m",
             cells(extent.x()), cells(extent.y())));
  }
  g.rows = static_cast<int>(cells(extent.x()));
  g.cols = static_cast<int>(cells(extent.y()));
  g.north_min_m = low.x();
  g.east_min_m = low.y();
  // The northernmost point may lie on the rim exactly; the half-open cell must hold it.
  TerrainPoints points;
  points.reserve(p_W.size());
  for (const Eigen::Vector3d& p : p_W) {
    points.push_back({std::min(p.x(), g.north_max_m() - 1e-9), p.y(), -p.z(), 0});
  }
  ElevationMap map = AccumulateCells(points, g, slad.mode, 1, {});
  FillHoles(map, slad.data_size_cells, slad.border_size_cells);
  return map;
}

SiteContext WithoutVehicle() {
  SiteContext context;
  context.p_WB.setConstant(std::nan(""));
  return context;
}

}  // namespace

Result<AnalyzeInput> ElevationOfPair(const std::filesystem::path& left,
                                     const std::filesystem::path& right,
                                     const std::filesystem::path& rig_path, Settings settings) {
  AnalyzeInput input;
  Stopwatch watch;
  const auto file = LoadRigFile(rig_path);
  if (!file) {
    return file.error();
  }
  auto left_raw = ReadGreyPicture(left);
  auto right_raw = ReadGreyPicture(right);
  if (!left_raw || !right_raw) {
    return left_raw ? right_raw.error() : left_raw.error();
  }
  const StereoRig& rig = file->rig;
  const auto rectifier = StereoRectifier::Make(rig);
  if (!rectifier) {
    return InvalidError(rig_path.string() + ": " + rectifier.error().message);
  }
  input.timings.push_back(watch.Lap("read"));
  const StereoFrame raw{{}, std::move(left_raw).value(), std::move(right_raw).value()};
  const auto pair = rectifier->Rectify(raw);
  if (!pair) {
    return InvalidError(left.string() + ", " + right.string() + ": " + pair.error().message);
  }
  input.timings.push_back(watch.Lap("rectify"));
  const RigidTransform X_WB = file->pose ? file->pose->X_WB : RigidTransform{};
  if (!file->pose) {
    input.warnings.push_back(rig_path.string() +
                             " has no [pose]: attitude taken as level, heights from the camera");
  }
  RigidTransform X_WC = X_WB * rig.X_BC();
  X_WC.R = X_WC.R * rectifier->R_C_Rect();
  DisparityWindow window{rig.min_disparity_px, (rig.num_disparities + 15) / 16 * 16};
  if (rig.num_disparities == 0) {
    if (!file->pose) {
      return InvalidError(rig_path.string() +
                          ": needs [pose] height_m, or [rig] min_disparity_px and "
                          "num_disparities, to know where to search");
    }
    window = PredictWindow(rectifier->camera(), rectifier->baseline_m(), X_WC, 0, kTallestObject_m,
                           settings.stereo);
  }
  const auto filtered = FilterThenRectify(raw, *rectifier, settings.stereo);
  StereoMatcher matcher;
  auto match =
      matcher.Match(*pair->left, *pair->right, rectifier->camera(), rectifier->baseline_m(), window,
                    settings.stereo, {}, filtered ? &*filtered : nullptr);
  if (!match) {
    return InvalidError(left.string() + ", " + right.string() + ": " + match.error().message);
  }
  input.timings.push_back(watch.Lap("stereo"));
  if (match->quality.coverage < 0.05) {
    input.warnings.push_back(
        Text("only %.1f %% of the picture could be matched; check rig, "
             "disparity window and texture",
             100 * match->quality.coverage));
  }
  if (match->quality.suspect_swapped) {
    input.warnings.push_back("left and right look exchanged");
  }
  if (match->quality.suspect_same) {
    input.warnings.push_back("left and right are the same picture");
  }
  const GroundBounds bounds = BoundsOfData(PointsFromRange(match->range, X_WC));
  CoverExtent(bounds.north_max_m - bounds.north_min_m, bounds.east_max_m - bounds.east_min_m,
              settings.slad, input.warnings);
  input.map = ElevationFromRange(match->range, X_WC, settings.slad);
  input.timings.push_back(watch.Lap("elevation"));
  input.left = *pair->left;
  input.stereo = match->quality;
  input.range = std::move(match->range);
  input.context.p_WB = X_WB.p;
  input.context.X_WC = X_WC;
  input.context.camera = rectifier->camera();
  input.context.glide_slope_rad = settings.mission.glide_slope_deg * kRadPerDeg;
  return input;
}

Result<AnalyzeInput> ElevationOfModel(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings) {
  AnalyzeInput input;
  Stopwatch watch;
  const auto layer = ReadGeoTiff(path);
  if (!layer) {
    return layer.error();
  }
  input.epsg = layer->epsg;
  input.context = WithoutVehicle();
  input.timings.push_back(watch.Lap("read"));
  if (cell_m && std::abs(*cell_m - layer->geometry.cell_m) > 1e-6) {
    std::vector<Eigen::Vector3d> points;
    for (int r = 0; r < layer->geometry.rows; ++r) {
      for (int c = 0; c < layer->geometry.cols; ++c) {
        points.emplace_back(layer->geometry.EastOfCol(c), layer->geometry.NorthOfRow(r),
                            static_cast<double>(layer->cells.at(r, c)));
      }
    }
    auto map = MapOfPoints(points, cell_m, settings.slad, input.warnings);
    if (!map) {
      return Error{map.error().code, path.string() + ": " + map.error().message};
    }
    input.map = std::move(map).value();
  } else {
    input.map = MapOfLayer(*layer);
    FillHoles(input.map, settings.slad.data_size_cells, settings.slad.border_size_cells);
  }
  input.timings.push_back(watch.Lap("elevation"));
  return input;
}

Result<AnalyzeInput> ElevationOfCloud(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings) {
  AnalyzeInput input;
  Stopwatch watch;
  const auto points = ReadPointFile(path);
  if (!points) {
    return points.error();
  }
  input.context = WithoutVehicle();
  input.timings.push_back(watch.Lap("read"));
  auto map = MapOfPoints(*points, cell_m, settings.slad, input.warnings);
  if (!map) {
    return Error{map.error().code, path.string() + ": " + map.error().message};
  }
  input.map = std::move(map).value();
  input.timings.push_back(watch.Lap("elevation"));
  return input;
}

}  // namespace palace
