#include "engine/tools/analyze_inputs.h"

#include <cmath>
#include <utility>

#include "engine/core/address_space.h"
#include "engine/core/text.h"
#include "engine/geodata/geo_tiff.h"
#include "engine/geodata/point_files.h"
#include "engine/slad/terrain/hole_filling.h"
#include "engine/survey/cloud_elevation.h"

namespace palace {
namespace {

/// A model states no noise of its own.
constexpr double kModelSigma_m = 0.001;

/// Bytes a cell at the worst moment, that of measuring, beside some 450 MiB that the program has
/// anyway: 158 in modern mode and 124 in thesis mode, measured from 1024 to 8192 cells a side.
constexpr std::size_t kModernCellBytes = 162, kThesisCellBytes = 128;
/// The part of them that the elevation map has.
constexpr std::size_t kMapCellBytes = 11;
/// Of a model whose cells are changed: the model, its points, and those that are kept of them.
constexpr std::size_t kResampledCellBytes = 100;

std::size_t CellBytes(SladMode mode) {
  return mode == SladMode::kModern ? kModernCellBytes : kThesisCellBytes;
}

Status RoomFor(const GridGeometry& map, std::size_t cell_bytes, const std::string& remedy) {
  const auto cells = static_cast<std::size_t>(map.rows) * static_cast<std::size_t>(map.cols);
  const Status room = EnoughMemory((cells * cell_bytes >> 20) + 1);
  return room ? room
              : Error{room.error().code, std::to_string(map.cols) + " x " +
                                             std::to_string(map.rows) +
                                             " cells: " + room.error().message + ", or " + remedy};
}

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
      map.variance_m2.cells()[i] = static_cast<float>(kModelSigma_m * kModelSigma_m);
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

}  // namespace

Status RoomToDecide(const GridGeometry& map, SladMode mode, const std::string& remedy) {
  return RoomFor(map, CellBytes(mode) - kMapCellBytes, remedy);
}

Result<AnalyzeInput> ElevationOfModel(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings) {
  AnalyzeInput input;
  const auto changes = [&](const GridGeometry& model) {
    return cell_m && std::abs(*cell_m - model.cell_m) > 1e-6;
  };
  const auto layer = ReadGeoTiff(path, [&](const GridGeometry& model) {
    const std::string remedy = "cut the model with gdal_translate -srcwin";
    return RoomFor(model, changes(model) ? kResampledCellBytes : CellBytes(settings.slad.mode),
                   remedy);
  });
  if (!layer) {
    return layer.error();
  }
  input.epsg = layer->epsg;
  input.watch.Lap("read");
  ElevationMap map;
  if (changes(layer->geometry)) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(layer->cells.cells().size());
    for (int r = 0; r < layer->geometry.rows; ++r) {
      for (int c = 0; c < layer->geometry.cols; ++c) {
        const double height_m = static_cast<double>(layer->cells.at(r, c));
        if (!std::isnan(height_m)) {
          points.emplace_back(layer->geometry.EastOfCol(c), layer->geometry.NorthOfRow(r),
                              height_m);
        }
      }
    }
    auto cloud = MapOfCloud(points, cell_m, settings.slad, input.warnings);
    if (!cloud) {
      return Error{cloud.error().code, path.string() + ": " + cloud.error().message};
    }
    map = std::move(cloud).value();
    if (settings.slad.mode == SladMode::kModern && *cell_m < layer->geometry.cell_m) {
      input.warnings.push_back(
          WithNumbers("--cell-m %.3g is finer than the model's cells of %.3g m: cells between its "
                      "heights are filled or unknown",
                      *cell_m, layer->geometry.cell_m));
    }
  } else {
    map = MapOfLayer(*layer, input.warnings);
    WarnOfLayout(layer->geometry, settings.slad, input.warnings);
    FillHoles(map, settings.slad.grid.data_size_cells, settings.slad.grid.border_size_cells);
  }
  input.slad.Take(std::move(map));
  input.watch.Lap("elevation");
  return input;
}

Result<AnalyzeInput> ElevationOfCloud(const std::filesystem::path& path,
                                      std::optional<double> cell_m, const Settings& settings) {
  AnalyzeInput input;
  const auto points = ReadPointFile(path);
  if (!points) {
    return points.error();
  }
  input.watch.Lap("read");
  auto map = MapOfCloud(*points, cell_m, settings.slad, input.warnings);
  if (!map) {
    return Error{map.error().code, path.string() + ": " + map.error().message};
  }
  input.slad.Take(std::move(map).value());
  input.watch.Lap("elevation");
  return input;
}

}  // namespace palace
