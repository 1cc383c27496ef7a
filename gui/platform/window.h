// Window: the GLFW window with its OpenGL 3.3 core context, and the input that came in.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "gui/render/picture.h"

struct GLFWwindow;

namespace palace {

enum class KeyAction { kPress, kRepeat, kRelease };
/// `key` and `mods` are GLFW's numbers. `name` is the character the key prints on this keyboard
/// ("z" on a QWERTY Z and on an AZERTY Z alike), empty for keys that print none.
struct KeyEvent {
  int key = 0;
  int mods = 0;
  KeyAction action = KeyAction::kPress;
  std::string name;
};

/// Left, right and middle, in GLFW's order.
inline constexpr int kPointerButtons = 3;
/// The pointer moved, or a button changed where it was then; in screen coordinates of the window.
struct PointerEvent {
  float x = 0, y = 0;
  int button = -1;  ///< -1: none changed
  bool down = false;
};

/// Everything since the last call that ImGui does not take itself: a press and release inside one
/// frame is not lost.
struct WindowInput {
  std::vector<KeyEvent> keys;
  std::vector<PointerEvent> pointer;
  bool focused = true;
  bool close_requested = false;
};

/// Main thread only. The context is current on it from Open to the destructor.
class Window {
 public:
  /// Size in screen pixels. kUnavailable when there is no display, saying how to run without one.
  static Result<std::unique_ptr<Window>> Open(const std::string& title, int width_px, int height_px,
                                              bool hidden = false);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Handles what came in and hands it over. Waits at most `wait_s` when nothing is there.
  WindowInput PollInput(double wait_s = 0);
  /// Shows what was drawn; waits for the display's refresh unless hidden.
  void SwapBuffers();
  /// Binds the window's own framebuffer and sets the viewport.
  void BeginFrame();
  ImageRgba ReadPixels() const;  ///< row 0 on top; call before SwapBuffers

  int width_px() const;  ///< of the framebuffer
  int height_px() const;
  double dots_per_inch() const;  ///< of the monitor; 96 when it does not say
  bool minimised() const;
  /// The processor draws (Mesa's software drivers), not a graphics card.
  bool DrawsInSoftware() const;
  /// The driver lost the context's content; only drivers that can tell do.
  bool ContextLost() const;
  void SetSize(int width_px, int height_px);
  GLFWwindow* handle() const { return window_; }

 private:
  struct Latch;
  Window(GLFWwindow* window, std::unique_ptr<Latch> latch);
  static void InstallCallbacks(GLFWwindow* window);

  GLFWwindow* window_ = nullptr;
  unsigned (*reset_status_)() = nullptr;  ///< of GL; null where the driver cannot tell
  std::unique_ptr<Latch> latch_;
};

}  // namespace palace
