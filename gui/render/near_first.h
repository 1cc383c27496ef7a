// Draws what a camera sees of a mesh, near parts first: what they hide is not shaded.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "gui/render/mesh_buffer.h"

namespace palace {

/// Of a mesh's index, drawn together.
struct MeshRun {
  std::uint32_t first_index = 0, indices = 0;
  Eigen::AlignedBox3d box;  ///< round its corners, from the camera; metres, axes of W
};

/// With the clip of positions relative to the camera, only the runs that reach into its view: the
/// picture is the same to the bit.
void DrawNearFirst(const MeshBuffer& mesh, const std::vector<MeshRun>& runs,
                   const Eigen::Matrix4f* clip);

}  // namespace palace
