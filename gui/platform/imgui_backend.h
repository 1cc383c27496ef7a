// ImGuiBackend: the ImGui context and its drawing, over a window or offscreen.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "engine/core/result.h"
#include "gui/platform/fonts.h"

namespace palace {

class Window;
class Offscreen;

/// One at a time, on the thread whose GL context is current. ImGui's keyboard navigation and ini
/// file stay off.
class ImGuiBackend {
 public:
  static constexpr std::uint32_t kDarkWindow = 0xFF100C09;
  /// Input, clipboard, cursor and display size come from GLFW.
  static Result<std::unique_ptr<ImGuiBackend>> ForWindow(Window& window, double ui_scale);
  /// The caller feeds ImGui::GetIO() (mouse, keys, DeltaTime) before BeginFrame.
  static Result<std::unique_ptr<ImGuiBackend>> ForOffscreen(Offscreen& offscreen, double ui_scale);
  ~ImGuiBackend();
  ImGuiBackend(const ImGuiBackend&) = delete;
  ImGuiBackend& operator=(const ImGuiBackend&) = delete;

  /// Starts an ImGui frame. `delta_s` > 0 replaces the measured time step (headless, tests).
  /// `feed` may replace the backend's input before ImGui reads it (scripts).
  void BeginFrame(double delta_s = 0, const std::function<void()>& feed = {});
  /// Ends the frame and draws it into the window or the offscreen framebuffer, after clearing it
  /// with `background` (0xAABBGGRR): a fill as large as the window took a fifth of a frame where
  /// pixels are drawn in software. `draw` false ends it without making pixels.
  void EndFrame(std::uint32_t background = kDarkWindow, bool draw = true);
  /// Rebuilds the font atlas at another scale; between frames only. The fonts move: take them anew.
  void SetUiScale(double ui_scale);
  double ui_scale() const { return ui_scale_; }
  const Fonts& fonts() const { return fonts_; }

 private:
  ImGuiBackend(Window* window, Offscreen* offscreen) : window_(window), offscreen_(offscreen) {}
  Status Start(double ui_scale);

  Window* window_ = nullptr;
  Offscreen* offscreen_ = nullptr;
  bool platform_started_ = false;
  bool renderer_started_ = false;
  double ui_scale_ = 1;
  Fonts fonts_;
};

}  // namespace palace
