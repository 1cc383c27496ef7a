// What other people's files bring into a simulated world: shapes from meshes, relief from elevation
// models.
#pragma once

#include <filesystem>
#include <functional>

#include "engine/core/result.h"
#include "engine/world/height_field.h"
#include "engine/world/shapes.h"

namespace palace {

struct MeshImport {
  double scale = 1;          ///< metres for each unit of the file
  bool y_up = false;         ///< the file's y points up and its z south; else z up, y north
  bool may_be_open = false;  ///< else a surface with an edge is refused
};
/// In the frame O of a shape: x is the file's north, y its east, and the file's origin the middle
/// of the foot. Refuses, naming file and limit, what ReadMeshFile refuses, open meshes, and those
/// larger than kLargestMesh_m.
Result<Shape> ImportMesh(const std::filesystem::path& path, const MeshImport& import);
inline constexpr double kLargestMesh_m = 100;

/// Height over a square of W, up-positive, 0 where W begins; bilinear between the middles of the
/// file's cells.
using HeightFunction = std::function<double(double north_m, double east_m)>;
/// The file's middle lies at (north, east) of W. The file must know every cell of the square, and
/// the place where W begins. Memory: at most what ReadGeoTiff takes, 256 MB.
Result<HeightFunction> ImportHeights(const std::filesystem::path& path,
                                     const Eigen::Vector2d& middle_m,
                                     const HeightField::Place& square);

}  // namespace palace
