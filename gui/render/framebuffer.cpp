#include "gui/render/framebuffer.h"

#include <algorithm>
#include <limits>
#include <string>

namespace palace {
namespace {

bool Complete() { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

}  // namespace

Status Framebuffer::Resize(int width, int height, PixelKind kind, int samples) {
  GLint most_samples = std::numeric_limits<GLint>::max();
  GLint most_pixels = 1;
  for (const GLenum limit :
       {GL_MAX_SAMPLES, GL_MAX_COLOR_TEXTURE_SAMPLES, GL_MAX_DEPTH_TEXTURE_SAMPLES}) {
    GLint most = 1;
    glGetIntegerv(limit, &most);
    most_samples = std::min(most_samples, most);
  }
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_pixels);
  samples = std::clamp(samples, 1, std::max<int>(1, most_samples));
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
  sample_at_.clear();
  colour_samples_.Reset();
  depth_samples_.Reset();
  if (samples == 1) {
    resolved_depth_ = GlRenderbuffer::Create();
    glBindRenderbuffer(GL_RENDERBUFFER, resolved_depth_.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              resolved_depth_.name());
    return Complete() ? Ok() : UnavailableError("this OpenGL driver refuses our render target");
  }
  multisampled_ = GlFramebuffer::Create();
  colour_samples_ = GlTexture::Create();
  depth_samples_ = GlTexture::Create();
  struct Attachment {
    GLuint samples;
    GLenum format, point;
  };
  glBindFramebuffer(GL_FRAMEBUFFER, multisampled_.name());
  for (const Attachment& attached :
       {Attachment{colour_samples_.name(), format, GL_COLOR_ATTACHMENT0},
        Attachment{depth_samples_.name(), GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT}}) {
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, attached.samples);
    glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, attached.format, width, height,
                            GL_TRUE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attached.point, GL_TEXTURE_2D_MULTISAMPLE,
                           attached.samples, 0);
  }
  if (!Complete()) {
    return UnavailableError("this OpenGL driver refuses our render target");
  }
  GLint given = 0;
  glGetIntegerv(GL_SAMPLES, &given);
  sample_at_.assign(static_cast<std::size_t>(given), {0.5F, 0.5F});
  for (std::size_t i = 0; i < sample_at_.size(); ++i) {
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), sample_at_[i].data());
  }
  return Ok();
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

void Framebuffer::BeginResolve() const {
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
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
