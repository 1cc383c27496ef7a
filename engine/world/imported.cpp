#include "engine/world/imported.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "engine/core/text.h"
#include "engine/geodata/geo_tiff.h"
#include "engine/geodata/mesh_file.h"

namespace palace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMostRise_m = 60;

Error Refused(const std::filesystem::path& path, const std::string& what) {
  return InvalidError(path.string() + ": " + what);
}

Vector3d InO(const Vector3d& p, const MeshImport& import) {
  return import.scale *
         (import.y_up ? Vector3d(-p.z(), p.x(), -p.y()) : Vector3d(p.y(), p.x(), -p.z()));
}

std::string Place(const Vector3d& p) {
  return WithNumbers("(%.6g, %.6g, %.6g)", p.x(), p.y(), p.z());
}

/// An elevation model laid into W.
class Raster {
 public:
  Raster(MapLayer layer, const Vector2d& middle_m) : layer_(std::move(layer)) {
    const GridGeometry& g = layer_.geometry;
    north_max_m_ = middle_m.x() + g.rows * g.cell_m / 2;
    east_min_m_ = middle_m.y() - g.cols * g.cell_m / 2;
  }

  bool Covers(double north_m, double east_m) const {
    const GridGeometry& g = layer_.geometry;
    return north_m <= north_max_m_ && north_m >= north_max_m_ - g.rows * g.cell_m &&
           east_m >= east_min_m_ && east_m <= east_min_m_ + g.cols * g.cell_m;
  }

  /// NaN where one of the four cells about the place is unknown; the rim's own half cell is level.
  double Height(double north_m, double east_m) const {
    const GridGeometry& g = layer_.geometry;
    const auto split = [](double at, int cells) {
      const double held = std::clamp(at, 0.0, static_cast<double>(cells - 1));
      const int low = std::min(static_cast<int>(held), std::max(0, cells - 2));
      return std::pair(low, held - low);
    };
    const auto [row, r] = split((north_max_m_ - north_m) / g.cell_m - 0.5, g.rows);
    const auto [col, c] = split((east_m - east_min_m_) / g.cell_m - 0.5, g.cols);
    const int next_row = std::min(row + 1, g.rows - 1), next_col = std::min(col + 1, g.cols - 1);
    const auto cell = [&](int i, int j) { return static_cast<double>(layer_.cells.at(i, j)); };
    return (1 - r) * ((1 - c) * cell(row, col) + c * cell(row, next_col)) +
           r * ((1 - c) * cell(next_row, col) + c * cell(next_row, next_col));
  }

  std::string Extent() const {
    const GridGeometry& g = layer_.geometry;
    return WithNumbers("north %.1f to %.1f m, ", north_max_m_ - g.rows * g.cell_m, north_max_m_) +
           WithNumbers("east %.1f to %.1f m", east_min_m_, east_min_m_ + g.cols * g.cell_m);
  }
  double cell_m() const { return layer_.geometry.cell_m; }

 private:
  MapLayer layer_;
  double north_max_m_ = 0;
  double east_min_m_ = 0;
};

}  // namespace

Result<Shape> ImportMesh(const std::filesystem::path& path, const MeshImport& import) {
  Result<MeshFile> file = ReadMeshFile(path);
  if (!file) {
    return file.error();
  }
  if (!import.may_be_open) {
    if (const OpenEdges open = FindOpenEdges(*file); open.count > 0) {
      return Refused(path, "is open: " + std::to_string(open.count) +
                               " edges belong to one triangle, the first from " +
                               Place(open.first_from) + " to " + Place(open.first_to) +
                               "; close it, or write open = true");
    }
  }
  Eigen::AlignedBox3d box;
  for (Vector3d& vertex : file->vertices) {
    vertex = InO(vertex, import);
    box.extend(vertex);
  }
  const double reach_m = std::max(
      {box.sizes().maxCoeff(), 2 * box.min().head<2>().norm(), 2 * box.max().head<2>().norm()});
  if (reach_m > kLargestMesh_m) {
    return Refused(path, WithNumbers("reaches over %.6g m about its origin, the limit is %.0f m; "
                                     "check scale and where its origin lies",
                                     reach_m, kLargestMesh_m));
  }
  return Shape(Mesh{
      std::make_shared<const TriangleMesh>(std::move(file->vertices), std::move(file->triangles))});
}

Result<HeightFunction> ImportHeights(const std::filesystem::path& path, const Vector2d& middle_m,
                                     const HeightField::Place& square) {
  Result<MapLayer> layer = ReadGeoTiff(path);
  if (!layer) {
    return layer.error();
  }
  const auto raster = std::make_shared<const Raster>(std::move(*layer), middle_m);
  const double north_max_m = square.north_m + square.size_m;
  const double east_max_m = square.east_m + square.size_m;
  if (!raster->Covers(square.north_m, square.east_m) || !raster->Covers(north_max_m, east_max_m) ||
      !raster->Covers(0, 0)) {
    return Refused(path, "lies over " + raster->Extent() +
                             WithNumbers(", and the relief needs north %.1f to %.1f m, ",
                                         square.north_m, north_max_m) +
                             WithNumbers("east %.1f to %.1f m", square.east_m, east_max_m) +
                             "; give a larger file, a smaller size_m, or at");
  }
  const double start_m = raster->Height(0, 0);
  double lowest_m = start_m, highest_m = start_m;
  int unknown = std::isnan(start_m) ? 1 : 0;
  const int steps = std::max(1, static_cast<int>(std::ceil(square.size_m / raster->cell_m())));
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const double height_m = raster->Height(square.north_m + square.size_m * i / steps,
                                             square.east_m + square.size_m * j / steps);
      unknown += std::isnan(height_m) ? 1 : 0;
      lowest_m = std::fmin(lowest_m, height_m);
      highest_m = std::fmax(highest_m, height_m);
    }
  }
  if (unknown > 0) {
    return Refused(path, std::to_string(unknown) +
                             " places of the relief are unknown in it; fill them, e.g. with "
                             "gdal_fillnodata.py");
  }
  if (!(highest_m - lowest_m <= kMostRise_m)) {
    return Refused(path, WithNumbers("rises %.6g m over the relief, the limit is %.0f m",
                                     highest_m - lowest_m, kMostRise_m));
  }
  return HeightFunction([raster, start_m](double north_m, double east_m) {
    return raster->Height(north_m, east_m) - start_m;
  });
}

}  // namespace palace
