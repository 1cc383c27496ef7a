// Framebuffer: a multisampled render target that resolves into a texture, with read-back.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "gui/render/gl_handle.h"
#include "gui/render/picture.h"

namespace palace {

enum class PixelKind { kGrey, kRgba };

/// Row 0 of memory is GL's bottom row. Renderers that project with y downwards therefore store the
/// top row of the picture first; the flip happens in their projection, nowhere else.
class Framebuffer {
 public:
  /// (Re)creates the target when size, kind or samples changed; else does nothing. samples 1: no
  /// multisampling. A count above the driver's limit is lowered to it.
  Status Resize(int width, int height, PixelKind kind, int samples);
  /// Binds for drawing and sets the viewport to the whole target.
  void Bind() const;
  /// Binds, sets the state in which the scene renderers start a picture (depth by GL_LESS, nothing
  /// culled, blended or cut out) and clears colour to that grey level, depth and stencil.
  void Begin(float grey) const;
  /// Multisampled content into the texture. Call after drawing, before texture() or a read.
  void Resolve() const;
  /// Rows in memory order. kGrey and kRgba targets respectively.
  ImageU8 ReadGrey() const;
  /// Of a target without multisampling: window depth 0 .. 1, as GL stores it; 1 where nothing was
  /// drawn.
  ImageF ReadDepth() const;
  ImageRgba ReadRgba() const;

  /// Instead of Resolve: binds the picture without its samples, for a shader that makes one of the
  /// other. Nothing is cleared, depth is neither asked nor written.
  void BeginResolve() const;
  /// The samples, GL_TEXTURE_2D_MULTISAMPLE; 0 in a target without them.
  GLuint colour_samples() const { return colour_samples_.name(); }
  GLuint depth_samples() const { return depth_samples_.name(); }
  /// Where they lie in their pixel, 0 .. 1 as GL's window coordinates count.
  const std::vector<Eigen::Vector2f>& sample_at() const { return sample_at_; }

  GLuint texture() const { return texture_.name(); }
  GLuint name() const { return resolved_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GlFramebuffer resolved_;
  GlTexture texture_;
  GlRenderbuffer resolved_depth_;  ///< without multisampling only
  GlFramebuffer multisampled_;
  GlTexture colour_samples_;
  GlTexture depth_samples_;
  std::vector<Eigen::Vector2f> sample_at_;
  int width_ = 0;
  int height_ = 0;
  int samples_ = 0;
  PixelKind kind_ = PixelKind::kGrey;
};

}  // namespace palace
