#include "gui/render/framebuffer.h"

#include <algorithm>
#include <string>

namespace palace {
namespace {

bool Complete() { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

}  // namespace

Status Framebuffer::Resize(int width, int height, PixelKind kind, int samples) {
  GLint most_samples = 1;
  GLint most_pixels = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_pixels);
  samples = std::clamp(samples, 1, std::max(1, static_cast<int>(most_samples)));
  if (width < 1 || height < 1 || width > most_pixels || height > most_pixels) {
    return UnavailableError("picture of " + std::to_string(width) + "x" + std::to_string(height) +
                            " pixels: this OpenGL driver draws 1 to " +
                            std::to_string(most_pixels) + " pixels a side");
  }
  if (texture_ && width == width_ && height == height_ && kind == kind_ && samples == samples_) {
    return Ok();
  }
  width_ = width;
  height_ = height;
  kind_ = kind;
  samples_ = samples;
  const GLenum format = kind == PixelKind::kGrey ? GL_R8 : GL_RGBA8;

  texture_ = GlTexture::Create();
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0,
               kind == PixelKind::kGrey ? GL_RED : GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  resolved_ = GlFramebuffer::Create();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  resolved_depth_.Reset();
  multisampled_.Reset();
  if (samples == 1) {
    resolved_depth_ = GlRenderbuffer::Create();
    glBindRenderbuffer(GL_RENDERBUFFER, resolved_depth_.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              resolved_depth_.name());
    return Complete() ? Ok() : UnavailableError("this OpenGL driver refuses our render target");
  }
  multisampled_ = GlFramebuffer::Create();
  colour_samples_ = GlRenderbuffer::Create();
  depth_samples_ = GlRenderbuffer::Create();
  glBindFramebuffer(GL_FRAMEBUFFER, multisampled_.name());
  glBindRenderbuffer(GL_RENDERBUFFER, colour_samples_.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                            colour_samples_.name());
  glBindRenderbuffer(GL_RENDERBUFFER, depth_samples_.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH24_STENCIL8, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                            depth_samples_.name());
  return Complete() ? Ok() : UnavailableError("this OpenGL driver refuses our render target");
}

void Framebuffer::Bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, multisampled_ ? multisampled_.name() : resolved_.name());
  glViewport(0, 0, width_, height_);
}

void Framebuffer::Begin(float grey) const {
  Bind();
  for (const GLenum off : {GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST}) {
    glDisable(off);
  }
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_MULTISAMPLE);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glClearColor(grey, grey, grey, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void Framebuffer::Resolve() const {
  if (!multisampled_) {
    return;
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

ImageU8 Framebuffer::ReadGrey() const {
  ImageU8 picture(width_, height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RED, GL_UNSIGNED_BYTE, picture.pixels().data());
  return picture;
}

ImageF Framebuffer::ReadDepth() const {
  ImageF depth(width_, height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, depth.pixels().data());
  return depth;
}

ImageRgba Framebuffer::ReadRgba() const {
  ImageRgba picture(width_, height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels().data());
  return picture;
}

}  // namespace palace
