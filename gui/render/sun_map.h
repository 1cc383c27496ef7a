// SunMap: depth as the sun sees it, for shadows.
#pragma once

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "gui/render/gl_handle.h"

namespace palace {

class SunMap {
 public:
  static constexpr int kSize_px = 2048;
  /// An empty map: nothing hides anything.
  Status Create();
  /// Binds for drawing depth only, cleared. The caller binds its own target again.
  void Begin() const;
  GLuint texture() const { return depth_.name(); }

 private:
  GlTexture depth_;
  GlFramebuffer target_;
};

/// Orthographic: sun along -z, its clip box about all of the eight corners of a box of W.
Eigen::Matrix4f SunFromWorld(const Eigen::Vector3d& to_sun_W, const Eigen::Vector3d& low_W,
                             const Eigen::Vector3d& high_W);

}  // namespace palace
