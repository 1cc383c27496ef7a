#include "gui/platform/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace palace {
namespace {

Error NoOpenGl(const char* what) {
  return UnavailableError(std::string("no OpenGL without a window: ") + what +
                          "; install libegl1 and libgl1-mesa-dri (software rendering)");
}

}  // namespace

Result<std::unique_ptr<EglContext>> EglContext::Open() {
  EGLDisplay display =
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
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
  return std::unique_ptr<EglContext>(new EglContext(display, context));
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
