#include "gui/platform/offscreen.h"

#include <algorithm>
#include <utility>

namespace palace {

Result<std::unique_ptr<Offscreen>> Offscreen::Open(int width_px, int height_px) {
  Result<std::unique_ptr<EglContext>> context = EglContext::Open();
  if (!context) {
    return context.error();
  }
  if (const Status bound = (*context)->MakeCurrent(); !bound) {
    return bound.error();
  }
  std::unique_ptr<Offscreen> screen(new Offscreen(std::move(context).value()));
  if (const Status sized = screen->SetSize(width_px, height_px); !sized) {
    return sized.error();
  }
  return screen;
}

Offscreen::~Offscreen() {
  // GL objects die while their context is current; the member order alone would not bind it again.
  const Status bound = context_->MakeCurrent();
  if (bound.ok()) {
    target_ = Framebuffer();
  }
}

Status Offscreen::SetSize(int width_px, int height_px) {
  return target_.Resize(width_px, height_px, PixelKind::kRgba, 1);
}

void Offscreen::BeginFrame() { target_.Bind(); }

ImageRgba Offscreen::ReadPixels() const {
  const ImageRgba bottom_up = target_.ReadRgba();
  ImageRgba picture(bottom_up.width(), bottom_up.height());
  for (int y = 0; y < picture.height(); ++y) {
    const Rgba8* from = bottom_up.row(picture.height() - 1 - y);
    std::transform(from, from + picture.width(), picture.row(y), [](Rgba8 p) {
      return Rgba8{p.r, p.g, p.b, 255};
    });
  }
  return picture;
}

}  // namespace palace
