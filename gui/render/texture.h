// Texture: a two-dimensional GL texture that follows the size of the picture given to it.
#pragma once

#include "gui/render/gl_handle.h"
#include "gui/render/picture.h"

namespace palace {

enum class TextureFilter { kNearest, kLinear, kMipmap };

/// Row 0 of the picture lies at v = 0, so that ImGui's uv (0,0) is the top-left corner.
class Texture {
 public:
  /// Grey pictures are swizzled to (r, r, r, 1).
  void Upload(const ImageU8& picture, TextureFilter filter);
  void Upload(const ImageRgba& picture, TextureFilter filter);
  void SetFilter(TextureFilter filter);
  void Clear() { handle_.Reset(), width_ = height_ = 0; }

  /// 0 before the first upload.
  GLuint name() const { return handle_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void Store(int width, int height, bool grey, const void* pixels, TextureFilter filter);

  GlTexture handle_;
  int width_ = 0;
  int height_ = 0;
  bool grey_ = false;
};

}  // namespace palace
