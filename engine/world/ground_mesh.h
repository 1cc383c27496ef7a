// GroundMesh: the relief as few triangles, for renderers that draw triangles.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/world.h"

namespace palace {

/// Triangles of the relief's square, without the plane of the ground.
struct GroundMesh {
  /// A square block of it: a run of indices, all to corners of its own, and the box round these.
  struct Chunk {
    std::uint32_t first_index = 0, indices = 0;
    Eigen::AlignedBox3f box;  ///< north, east, height; metres
  };
  std::vector<Eigen::Vector3f> corners;  ///< north, east, height of the relief; metres
  std::vector<std::uint32_t> indices;    ///< three a triangle
  std::vector<Chunk> chunks;
};

/// Blocks of the grid whose corners lie within `tolerance_m` of the block's own two triangles are
/// drawn as these; neighbours of other size leave gaps of as much at most. Chunks are about a 32nd
/// of the square a side; what is flatter than that is one. Without relief two triangles of the
/// square that its GroundPicture covers.
GroundMesh MeshGround(const Ground& ground, double tolerance_m);

}  // namespace palace
