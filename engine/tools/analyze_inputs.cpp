#include "engine/tools/analyze_inputs.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/camera/files/rig_file.h"
#include "engine/camera/rectification.h"
#include "engine/capture/picture_file.h"
#include "engine/core/text.h"
#include "engine/core/time.h"
#include "engine/core/units.h"
#include "engine/slad/pictures/scene_flags.h"
#include "engine/slad/terrain/elevation_map_builder.h"
#include "engine/slad/terrain/hole_filling.h"
#include "engine/slad/terrain/terrain_points.h"
#include "engine/stereo/prefilter.h"
#include "engine/stereo/stereo.h"
#include "engine/survey/cloud_elevation.h"
#include "engine/survey/map_files.h"
#include "engine/survey/point_files.h"

namespace palace {
namespace {

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

ElevationMap MapOfLayer(const MapLayer& layer, std::vector<std::string>& warnings) {
  const GridGeometry& g = layer.geometry;
  ElevationMap map{{},
                   g,
                   layer.cells,
                   GridF(g.rows, g.cols, kUnknownValue),
                   Grid<std::uint16_t>(g.rows, g.cols, 0),
                   Grid<CellState>(g.rows, g.cols, CellState::kUnknown)};
  int not_on_earth = 0;
  for (std::size_t i = 0; i < layer.cells.cells().size(); ++i) {
    const double height_m = static_cast<double>(layer.cells.cells()[i]);
    if (IsOnEarth(height_m)) {
      map.variance_m2.cells()[i] = 1e-6F;  // a model states no noise
      map.frame_count.cells()[i] = 1;
      map.state.cells()[i] = CellState::kMeasured;
    } else {
      map.height_m.cells()[i] = kUnknownValue;
      not_on_earth += std::isnan(height_m) ? 0 : 1;
    }
  }
  if (not_on_earth > 0) {
    warnings.push_back(WithNumbers(
        "%.0f cells below -450 m or above 9000 m taken as no-data; does the file lack its no-data "
        "value?",
        not_on_earth));
  }
  return map;
}

/// The model's own grid stays. Settings that differ from the standard ones asked for another.
void WarnOfLayout(const GridGeometry& model, const SladSettings& asked,
                  std::vector<std::string>& warnings) {
  const SladSettings standard;
  if (asked.grid.cell_m != standard.grid.cell_m &&
      std::abs(asked.grid.cell_m - model.cell_m) > 1e-6) {
    warnings.push_back(
        WithNumbers("slad.cell_m = %.3g m leaves the model's cells of %.3g m as they are; use "
                    "--cell-m to change them",
                    asked.grid.cell_m, model.cell_m));
  }
  if (asked.grid.rows != standard.grid.rows || asked.grid.cols != standard.grid.cols) {
    warnings.push_back(WithNumbers(
        "slad.grid_rows and slad.grid_cols leave the model's %.0f x %.0f cells as they are",
        model.rows, model.cols));
  }
  if (asked.grid.bounds != standard.grid.bounds) {
    warnings.push_back("slad.bounds: an elevation model is taken whole");
  }
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
        WithNumbers("only %.1f %% of the picture could be matched; check rig, "
                    "disparity window and texture",
                    100 * match->quality.coverage));
  }
  if (match->quality.suspect_swapped) {
    input.warnings.push_back("left and right look exchanged");
  }
  if (match->quality.suspect_same) {
    input.warnings.push_back("left and right are the same picture");
  }
  match->range.pose = ViewPose{X_WC};
  const GroundBounds bounds = BoundsOfData(PointsFromRange(match->range));
  CoverExtent(bounds.north_max_m - bounds.north_min_m, bounds.east_max_m - bounds.east_min_m,
              settings.slad, input.warnings);
  input.map = ElevationFromRange(match->range, settings.slad);
  input.timings.push_back(watch.Lap("elevation"));
  if (settings.slad.mode == SladMode::kModern) {
    const auto range = std::make_shared<const RangeMap>(match->range);
    input.map.flags = SceneFlags().Add({pair->left, pair->right, range}, input.map.geometry);
    input.timings.push_back(watch.Lap("flags"));
  }
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
        const double height_m = static_cast<double>(layer->cells.at(r, c));
        if (!std::isnan(height_m)) {
          points.emplace_back(layer->geometry.EastOfCol(c), layer->geometry.NorthOfRow(r),
                              height_m);
        }
      }
    }
    auto map = MapOfCloud(points, cell_m, settings.slad, input.warnings);
    if (!map) {
      return Error{map.error().code, path.string() + ": " + map.error().message};
    }
    input.map = std::move(map).value();
    if (settings.slad.mode == SladMode::kModern && *cell_m < layer->geometry.cell_m) {
      input.warnings.push_back(
          WithNumbers("--cell-m %.3g is finer than the model's cells of %.3g m: cells between its "
                      "heights are filled or unknown",
                      *cell_m, layer->geometry.cell_m));
    }
  } else {
    input.map = MapOfLayer(*layer, input.warnings);
    WarnOfLayout(layer->geometry, settings.slad, input.warnings);
    FillHoles(input.map, settings.slad.grid.data_size_cells, settings.slad.grid.border_size_cells);
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
  auto map = MapOfCloud(*points, cell_m, settings.slad, input.warnings);
  if (!map) {
    return Error{map.error().code, path.string() + ": " + map.error().message};
  }
  input.map = std::move(map).value();
  input.timings.push_back(watch.Lap("elevation"));
  return input;
}

}  // namespace palace
