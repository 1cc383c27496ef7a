// LitResolve: the picture made of its samples, whose ground is lit only then: once a sample,
// however small the triangles are that the ground was drawn of.
#pragma once

#include <array>
#include <initializer_list>
#include <string_view>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "engine/model/rig.h"
#include "gui/render/framebuffer.h"
#include "gui/render/gl_handle.h"
#include "gui/render/shader.h"

namespace palace {

class LitResolve {
 public:
  static constexpr int kSamples = 4;
  /// How the ground's picture lies in the world: its texel; a place on the plane below which no
  /// ground is; the way up from that plane, of any length.
  struct Light {
    double texel_m = 0;
    Eigen::Vector3d lowest_W = Eigen::Vector3d::Zero();
    Eigen::Vector3d up_W = -Eigen::Vector3d::UnitZ();
  };

  /// `light_pieces`: the shaders' text before lit_resolve_fragment.glsl, of what it looks up.
  Status Build(std::initializer_list<std::string_view> light_pieces, const Light& light);
  /// Both programs, for the caller to set what their light pieces ask for.
  const std::array<ShaderProgram, 2>& programs() const { return programs_; }
  /// Into the picture of a target of kSamples whose samples hold greys and, black, ground; rows of
  /// the picture are rows of the window (ClipFromCamera).
  void Draw(const Framebuffer& drawn, const PinholeCamera& camera,
            const RigidTransform& X_WC) const;

 private:
  /// Whether all ground in that rectangle of the window is drawn larger than its texels.
  bool Enlarged(const Eigen::Matrix3d& ray_of_window, const Eigen::AlignedBox2d& part,
                const Eigen::Vector3d& p_W) const;

  Light light_;
  std::array<ShaderProgram, 2> programs_;  ///< anywhere; where texels are enlarged
  GlVertexArray no_corners_;
};

}  // namespace palace
