// Offscreen: the whole window without a window: an EGL surfaceless context and a framebuffer.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "gui/platform/egl_context.h"
#include "gui/render/framebuffer.h"
#include "gui/render/picture.h"

namespace palace {

/// One thread; the context is current on it from Open to the destructor.
class Offscreen {
 public:
  static Result<std::unique_ptr<Offscreen>> Open(int width_px, int height_px);
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  /// Binds the framebuffer and sets the viewport.
  void BeginFrame();
  Status SetSize(int width_px, int height_px);
  ImageRgba ReadPixels() const;  ///< row 0 on top, opaque
  int width_px() const { return target_.width(); }
  int height_px() const { return target_.height(); }

 private:
  explicit Offscreen(std::unique_ptr<EglContext> context) : context_(std::move(context)) {}
  std::unique_ptr<EglContext> context_;
  Framebuffer target_;
};

}  // namespace palace
