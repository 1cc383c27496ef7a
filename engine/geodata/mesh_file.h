// Triangle meshes from OBJ (Wavefront: v and f lines) and PLY files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"

namespace palace {

/// As the file has it, in its own unit and axes.
struct MeshFile {
  using Corners = std::array<std::uint32_t, 3>;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Corners> triangles;  ///< every index names a vertex; none twice in one triangle
};

/// About 200 bytes of memory a triangle where rays meet it, so 400 MB in all.
inline constexpr std::size_t kMostTriangles = 2'000'000;

/// Polygons become fans of triangles; texture, normals, groups and materials are passed over, and
/// triangles that name a vertex twice are left out. Refuses, naming file, line and limit, before
/// anything large is kept: files that are no mesh, without triangles, cut off, with indices or
/// numbers that mean nothing, or with more than kMostTriangles.
Result<MeshFile> ReadMeshFile(const std::filesystem::path& path);

/// An edge that only one triangle has. None: the mesh is closed. Vertices at the same place count
/// as one, as they do in files that repeat them.
struct OpenEdges {
  std::size_t count = 0;
  Eigen::Vector3d first_from = Eigen::Vector3d::Zero();
  Eigen::Vector3d first_to = Eigen::Vector3d::Zero();
};
OpenEdges FindOpenEdges(const MeshFile& mesh);

}  // namespace palace
