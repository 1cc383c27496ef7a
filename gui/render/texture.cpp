#include "gui/render/texture.h"

namespace palace {

void Texture::Upload(const ImageU8& picture, TextureFilter filter) {
  Store(picture.width(), picture.height(), true, picture.pixels().data(), filter);
}

void Texture::Upload(const ImageRgba& picture, TextureFilter filter) {
  Store(picture.width(), picture.height(), false, picture.pixels().data(), filter);
}

void Texture::Store(int width, int height, bool grey, const void* pixels, TextureFilter filter) {
  if (width == 0 || height == 0) {
    Clear();
    return;
  }
  const bool fits = handle_ && width == width_ && height == height_ && grey == grey_;
  if (!handle_) {
    handle_ = GlTexture::Create();
  }
  glBindTexture(GL_TEXTURE_2D, handle_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const GLenum format = grey ? GL_RED : GL_RGBA;
  if (fits) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, format, GL_UNSIGNED_BYTE, pixels);
  } else {
    glTexImage2D(GL_TEXTURE_2D, 0, grey ? GL_R8 : GL_RGBA8, width, height, 0, format,
                 GL_UNSIGNED_BYTE, pixels);
    const GLint grey_swizzle[] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    const GLint rgba_swizzle[] = {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, grey ? grey_swizzle : rgba_swizzle);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    width_ = width;
    height_ = height;
    grey_ = grey;
  }
  if (filter == TextureFilter::kMipmap) {
    glGenerateMipmap(GL_TEXTURE_2D);
  }
  SetFilter(filter);
}

void Texture::SetFilter(TextureFilter filter) {
  if (!handle_) {
    return;
  }
  glBindTexture(GL_TEXTURE_2D, handle_.name());
  const GLint mode = filter == TextureFilter::kNearest ? GL_NEAREST : GL_LINEAR;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                  filter == TextureFilter::kMipmap ? GL_LINEAR_MIPMAP_LINEAR : mode);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, mode);
}

}  // namespace palace
