// GroundBuffer: the mesh of a ground on the graphics device, drawn as far as a camera sees it.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/world/ground_mesh.h"
#include "gui/render/mesh_buffer.h"

namespace palace {

/// Where corners (north, east, height) of a mesh lie in W, as lit_ground_vertex.glsl places them:
/// mirrored or not, on the plane of the ground, lowered.
struct GroundPlacing {
  Eigen::Vector4f mirror{1, 0, 1, 0};  ///< north = x * north + y, east = z * east + w
  Eigen::Vector2f rise{0, 0};          ///< of the plane, per metre north and east
  float lower_m = 0;

  Eigen::AlignedBox3d Around(const Eigen::AlignedBox3f& box) const;
};

class GroundBuffer {
 public:
  void Start(const GroundMesh& mesh);
  /// Of the program in use, whose uniforms the caller has set to the placing.
  void Draw() const { mesh_.Draw(); }
  /// As near_first.h says, of the camera at p_W.
  void DrawNearFirst(const GroundPlacing& placing, const Eigen::Vector3d& p_W,
                     const Eigen::Matrix4f* clip) const;

 private:
  MeshBuffer mesh_;
  std::vector<GroundMesh::Chunk> chunks_;
};

}  // namespace palace
