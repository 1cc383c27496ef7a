#include "gui/platform/egl_context.h"

#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace palace {
namespace {

Error NoOpenGl(const char* what) {
  return UnavailableError(std::string("no OpenGL without a window: ") + what +
                          "; install libegl1 and libgl1-mesa-dri (software rendering)");
}

/// Mesa's own switch, honoured for every driver: pictures that are compared with recorded ones are
/// drawn in software.
bool SoftwareIsWanted() {
  const char* wish = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  const std::string_view value = wish != nullptr ? wish : "";
  return value == "1" || value == "true";
}

/// The graphics cards that EGL lists, then no device at all: the surfaceless platform, where Mesa
/// takes the card it drives, or draws in software. A card that Mesa does not drive is reached as a
/// device alone (EGL_EXT_platform_device).
std::vector<EGLDisplay> DisplaysToTry() {
  std::vector<EGLDisplay> displays;
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  const auto query_string = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
      eglGetProcAddress("eglQueryDeviceStringEXT"));
  if (query_devices != nullptr && query_string != nullptr && !SoftwareIsWanted()) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE) {
      count = 0;
    }
    for (EGLint i = 0; i < count; ++i) {
      const char* known = query_string(devices[i], EGL_EXTENSIONS);
      const std::string_view extensions = known != nullptr ? known : "";
      if (extensions.find("EGL_MESA_device_software") == extensions.npos) {
        displays.push_back(eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
      }
    }
  }
  displays.push_back(
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  return displays;
}

Result<EGLContext> CreateContext(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY) {
    return NoOpenGl("EGL has no surfaceless platform");
  }
  // The display is shared by all contexts of the process and never terminated: another context may
  // still live on it.
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    return NoOpenGl("EGL does not start");
  }
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
    return NoOpenGl("EGL offers no desktop OpenGL");
  }
  const EGLint config_wishes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                  EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, config_wishes, &config, 1, &count) == EGL_FALSE || count == 0) {
    return NoOpenGl("EGL offers no configuration");
  }
  const EGLint context_wishes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   3,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   3,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_wishes);
  if (context == EGL_NO_CONTEXT) {
    return NoOpenGl("OpenGL 3.3 core is not available");
  }
  return context;
}

}  // namespace

Result<std::unique_ptr<EglContext>> EglContext::Open() {
  Result<EGLContext> context = NoOpenGl("EGL has no display");
  for (EGLDisplay display : DisplaysToTry()) {
    context = CreateContext(display);
    if (context) {
      return std::unique_ptr<EglContext>(new EglContext(display, context.value()));
    }
  }
  return context.error();
}

EglContext::~EglContext() {
  if (IsCurrent()) {
    Release();
  }
  eglDestroyContext(display_, context_);
}

Status EglContext::MakeCurrent() {
  // The API is a property of the thread, and GLFW or other code may have bound another.
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
    return NoOpenGl("the context cannot be bound on this thread");
  }
  return Ok();
}

void EglContext::Release() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

bool EglContext::IsCurrent() const { return eglGetCurrentContext() == context_; }

EglScope::EglScope(EglContext& context)
    : display_(eglGetCurrentDisplay()),
      context_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)),
      ours_(context),
      status_(context.IsCurrent() ? Ok() : context.MakeCurrent()) {}

EglScope::~EglScope() {
  if (!status_.ok()) {
    return;
  }
  if (context_ == EGL_NO_CONTEXT) {
    ours_.Release();
  } else if (eglGetCurrentContext() != context_) {
    eglMakeCurrent(display_, draw_, read_, context_);
  }
}

}  // namespace palace
