// SolidBuffer: the solids of a world on the graphics device, drawn as far as a camera sees them.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/world.h"
#include "gui/render/mesh_buffer.h"

namespace palace {

/// Laid out as lit_object_vertex.glsl reads it.
class SolidBuffer {
 public:
  /// Each with its foot in the world's ground.
  void Start(const World& world, const std::vector<Solid>& solids);
  void Draw() const { mesh_.Draw(); }
  /// As near_first.h says, of the camera at p_W; all moved by moved_W.
  void DrawNearFirst(const Eigen::Vector3d& moved_W, const Eigen::Vector3d& p_W,
                     const Eigen::Matrix4f* clip) const;

 private:
  struct Part {
    std::uint32_t first_index = 0, indices = 0;
    Eigen::AlignedBox3f box_W;
  };
  MeshBuffer mesh_;
  std::vector<Part> parts_;  ///< one a solid
};

}  // namespace palace
