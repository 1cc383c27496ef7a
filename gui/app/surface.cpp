#include "gui/app/surface.h"

#include <algorithm>
#include <utility>

#include "gui/app/layout.h"
#include "gui/widgets/imgui_input.h"

namespace palace {
namespace {

constexpr double kCaptionEm_px = 13;
constexpr double kLeastCaption_pt = 9.7;
constexpr double kScaleStep = 0.25;

/// The smallest step at which a caption is large enough to read on this monitor.
double ScaleForMonitor(double dots_per_inch) {
  double scale = 0.75;
  while (scale < 2.5 && kCaptionEm_px * scale * 72 / dots_per_inch < kLeastCaption_pt) {
    scale += kScaleStep;
  }
  return std::max(1.0, scale);
}

std::string TitleOf(const AppOptions& options) {
  switch (options.source) {
    case SourceChoice::kReplay:
      return "REPLAY " + options.source_path + " - PALACE";
    case SourceChoice::kImages:
      return options.source_path + " - PALACE";
    case SourceChoice::kCameras:
      return "CAMERAS " + options.source_path + " - PALACE";
    case SourceChoice::kConnect:
      return "LIVE " + options.source_path + " - PALACE";
    case SourceChoice::kSimulation:
      return "SIM " + options.scenario + " - PALACE";
  }
  return "PALACE";
}

}  // namespace

Result<std::unique_ptr<Surface>> Surface::Open(const AppOptions& options) {
  std::unique_ptr<Surface> surface(new Surface());
  if (const Status started = surface->Start(options); !started) {
    return started.error();
  }
  return surface;
}

Status Surface::Start(const AppOptions& options) {
  options_ = options;
  if (options.headless) {
    auto offscreen = Offscreen::Open(options.width_px, options.height_px);
    if (!offscreen) {
      return offscreen.error();
    }
    offscreen_ = std::move(*offscreen);
  } else {
    auto window = Window::Open(TitleOf(options), options.width_px, options.height_px);
    if (!window) {
      return window.error();
    }
    window_ = std::move(*window);
  }
  const double scale = FittingScale(width_px(), height_px(),
                                    options.ui_scale > 0 ? options.ui_scale : natural_scale());
  auto backend = options.headless ? ImGuiBackend::ForOffscreen(*offscreen_, scale)
                                  : ImGuiBackend::ForWindow(*window_, scale);
  if (!backend) {
    return backend.error();
  }
  backend_ = std::move(*backend);
  if (options.headless || !options.script_file.empty()) {
    StartFedInput();
  }
  return Ok();
}

Status Surface::Reopen() {
  AppOptions options = options_;
  options.width_px = width_px();
  options.height_px = height_px();
  backend_.reset();
  window_.reset();
  offscreen_.reset();
  return Start(options);
}

int Surface::width_px() const { return window_ ? window_->width_px() : offscreen_->width_px(); }
int Surface::height_px() const { return window_ ? window_->height_px() : offscreen_->height_px(); }
bool Surface::minimised() const { return window_ && window_->minimised(); }

double Surface::natural_scale() const {
  return window_ ? ScaleForMonitor(window_->dots_per_inch()) : 1;
}

WindowInput Surface::Poll(double wait_s) {
  return window_ ? window_->PollInput(wait_s) : WindowInput{};
}

Status Surface::SetSize(int width_px, int height_px) {
  if (offscreen_) {
    return offscreen_->SetSize(width_px, height_px);
  }
  window_->SetSize(width_px, height_px);
  return Ok();
}

ImageRgba Surface::ReadPixels() const {
  return window_ ? window_->ReadPixels() : offscreen_->ReadPixels();
}

void Surface::Present() {
  if (window_) {
    window_->SwapBuffers();
  }
}

}  // namespace palace
