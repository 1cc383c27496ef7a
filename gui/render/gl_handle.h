// GlHandle: owns one GL object name. Destroy it while the context it came from is current.
#pragma once

#include <utility>

#include "gui/render/gl.h"

namespace palace {

template <typename Kind>
class GlHandle {
 public:
  GlHandle() = default;
  static GlHandle Create() {
    GlHandle handle;
    handle.name_ = Kind::Create();
    return handle;
  }
  /// Takes over a name made elsewhere (glCreateShader, glCreateProgram).
  static GlHandle Adopt(GLuint name) {
    GlHandle handle;
    handle.name_ = name;
    return handle;
  }
  ~GlHandle() { Reset(); }
  GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlHandle& operator=(GlHandle&& other) noexcept {
    if (this != &other) {
      Reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GlHandle(const GlHandle&) = delete;
  GlHandle& operator=(const GlHandle&) = delete;

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void Reset() {
    if (name_ != 0) {
      Kind::Delete(name_);
      name_ = 0;
    }
  }

 private:
  GLuint name_ = 0;
};

struct GlTextureKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenTextures(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteTextures(1, &name); }
};
struct GlBufferKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteBuffers(1, &name); }
};
struct GlVertexArrayKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct GlFramebufferKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct GlRenderbufferKind {
  static GLuint Create() {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    return name;
  }
  static void Delete(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct GlShaderKind {
  static void Delete(GLuint name) { glDeleteShader(name); }
};
struct GlProgramKind {
  static void Delete(GLuint name) { glDeleteProgram(name); }
};

using GlTexture = GlHandle<GlTextureKind>;
using GlBuffer = GlHandle<GlBufferKind>;
using GlVertexArray = GlHandle<GlVertexArrayKind>;
using GlFramebuffer = GlHandle<GlFramebufferKind>;
using GlRenderbuffer = GlHandle<GlRenderbufferKind>;
using GlShader = GlHandle<GlShaderKind>;
using GlProgram = GlHandle<GlProgramKind>;

}  // namespace palace
