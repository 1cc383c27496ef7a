// Surface: what the station is drawn into, a window or an offscreen picture, with its clock.
#pragma once

#include <memory>
#include <string>

#include "engine/core/result.h"
#include "gui/app/options.h"
#include "gui/platform/imgui_backend.h"
#include "gui/platform/offscreen.h"
#include "gui/platform/window.h"

namespace palace {

/// Main thread only; its GL context is current on it. A window shows every frame and runs in real
/// time; offscreen, engine and user interface go in lockstep, and pixels are made on demand.
class Surface {
 public:
  static Result<std::unique_ptr<Surface>> Open(const AppOptions& options);

  /// Offscreen: one engine pass, then one frame of kFrame_s, whatever the machine's speed.
  bool lockstep() const { return offscreen_ != nullptr; }
  int width_px() const;
  int height_px() const;
  bool minimised() const;
  /// The scale wanted where the command line says none.
  double natural_scale() const;
  ImGuiBackend& backend() { return *backend_; }

  /// What came in since the last call; waits at most `wait_s` for it. Offscreen nothing comes.
  WindowInput Poll(double wait_s);
  Status SetSize(int width_px, int height_px);
  ImageRgba ReadPixels() const;
  /// Shows what was drawn.
  void Present();
  /// The processor draws: what a frame costs is spent only while it is shown, and the engine waits
  /// for it.
  bool DrawsInSoftware() const { return window_ && window_->DrawsInSoftware(); }
  /// The driver lost everything that was uploaded (a reset of the graphics card).
  bool ContextLost() const { return window_ && window_->ContextLost(); }
  /// Begins anew with a context, and a window, of the same size. What was made with the old
  /// context must be gone.
  Status Reopen();

 private:
  Surface() = default;
  Status Start(const AppOptions& options);
  std::unique_ptr<Window> window_;  // one of the two
  std::unique_ptr<Offscreen> offscreen_;
  std::unique_ptr<ImGuiBackend> backend_;  // goes first
  AppOptions options_;
};

}  // namespace palace
