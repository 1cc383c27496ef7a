#include "gui/platform/window.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "gui/render/gl.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace palace {

/// What the callbacks saw since the last PollInput.
struct Window::Latch {
  WindowInput input;
  PointerEvent pointer;  ///< where it moved to last
  bool hidden = false;
};

namespace {

// Below it panels would lie over each other, and over WAVE OFF.
constexpr int kLeastWidth_px = 960, kLeastHeight_px = 540;

std::string GlfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

bool IsRobust(GLFWwindow* window) {
  return glfwGetWindowAttrib(window, GLFW_CONTEXT_ROBUSTNESS) == GLFW_LOSE_CONTEXT_ON_RESET;
}

bool IsSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

Result<std::unique_ptr<Window>> Window::Open(const std::string& title, int width_px, int height_px,
                                             bool hidden) {
  glfwSetErrorCallback(nullptr);
  if (!IsSet("DISPLAY") && !IsSet("WAYLAND_DISPLAY")) {
    return UnavailableError(
        "no display: neither DISPLAY nor WAYLAND_DISPLAY is set; start from a desktop session, or "
        "run with --headless");
  }
  if (glfwInit() == GLFW_FALSE) {
    return UnavailableError("no display: " + GlfwReason() +
                            "; start from a desktop session, or run with --headless");
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, hidden ? GLFW_FALSE : GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  GLFWwindow* handle = glfwCreateWindow(width_px, height_px, title.c_str(), nullptr, nullptr);
  if (handle == nullptr) {
    const std::string reason = GlfwReason();
    glfwTerminate();
    return UnavailableError("no window with OpenGL 3.3: " + reason +
                            "; install libgl1-mesa-dri, or run with --headless");
  }
  glfwMakeContextCurrent(handle);
  glfwSwapInterval(hidden ? 0 : 1);
  auto latch = std::make_unique<Latch>();
  latch->hidden = hidden;
  glfwSetWindowUserPointer(handle, latch.get());
  InstallCallbacks(handle);
  if (!hidden) {
    glfwSetWindowSizeLimits(handle, kLeastWidth_px, kLeastHeight_px, GLFW_DONT_CARE,
                            GLFW_DONT_CARE);
  }
  return std::unique_ptr<Window>(new Window(handle, std::move(latch)));
}

Window::Window(GLFWwindow* window, std::unique_ptr<Latch> latch)
    : window_(window), latch_(std::move(latch)) {
  for (const char* name : {"glGetGraphicsResetStatus", "glGetGraphicsResetStatusARB"}) {
    if (reset_status_ == nullptr && IsRobust(window)) {
      reset_status_ = reinterpret_cast<unsigned (*)()>(glfwGetProcAddress(name));
    }
  }
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

/// ImGui's backend installs its own callbacks later and calls these first.
void Window::InstallCallbacks(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    const char* name = glfwGetKeyName(key, scancode);
    const KeyAction what = action == GLFW_PRESS    ? KeyAction::kPress
                           : action == GLFW_REPEAT ? KeyAction::kRepeat
                                                   : KeyAction::kRelease;
    static_cast<Latch*>(glfwGetWindowUserPointer(w))
        ->input.keys.push_back({key, mods, what, name != nullptr ? name : ""});
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    auto* latch = static_cast<Latch*>(glfwGetWindowUserPointer(w));
    latch->pointer = {static_cast<float>(x), static_cast<float>(y)};
    latch->input.pointer.push_back(latch->pointer);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    if (button >= kPointerButtons) {
      return;
    }
    auto* latch = static_cast<Latch*>(glfwGetWindowUserPointer(w));
    // glfwGetCursorPos asks the display where the pointer is by now.
    PointerEvent change = latch->pointer;
    change.button = button;
    change.down = action == GLFW_PRESS;
    latch->input.pointer.push_back(change);
  });
}

WindowInput Window::PollInput(double wait_s) {
  if (wait_s > 0) {
    glfwWaitEventsTimeout(wait_s);
  } else {
    glfwPollEvents();
  }
  WindowInput input = std::exchange(latch_->input, {});
  input.focused = glfwGetWindowAttrib(window_, GLFW_FOCUSED) != 0;
  input.close_requested = glfwWindowShouldClose(window_) != 0;
  glfwSetWindowShouldClose(window_, GLFW_FALSE);  // a wish, told once; the program decides
  return input;
}

bool Window::DrawsInSoftware() const {
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view name = renderer != nullptr ? renderer : "";
  return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos;
}

void Window::SwapBuffers() { glfwSwapBuffers(window_); }

void Window::BeginFrame() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width_px(), height_px());
}

ImageRgba Window::ReadPixels() const {
  ImageRgba bottom_up(width_px(), height_px());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, bottom_up.width(), bottom_up.height(), GL_RGBA, GL_UNSIGNED_BYTE,
               bottom_up.pixels().data());
  ImageRgba picture(bottom_up.width(), bottom_up.height());
  for (int y = 0; y < picture.height(); ++y) {
    const Rgba8* from = bottom_up.row(picture.height() - 1 - y);
    std::copy(from, from + picture.width(), picture.row(y));
  }
  return picture;
}

int Window::width_px() const {
  int width = 0;
  glfwGetFramebufferSize(window_, &width, nullptr);
  return width;
}

int Window::height_px() const {
  int height = 0;
  glfwGetFramebufferSize(window_, nullptr, &height);
  return height;
}

double Window::dots_per_inch() const {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) {
    return 96;
  }
  int width_mm = 0, height_mm = 0;
  glfwGetMonitorPhysicalSize(monitor, &width_mm, &height_mm);
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  if (width_mm <= 0 || mode == nullptr) {
    return 96;
  }
  return mode->width / (width_mm / 25.4);
}

bool Window::minimised() const { return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0; }

bool Window::ContextLost() const {
  return reset_status_ != nullptr && reset_status_() != GL_NO_ERROR;
}

void Window::SetSize(int width_px, int height_px) {
  glfwSetWindowSize(window_, width_px, height_px);
}

}  // namespace palace
