// ShaderProgram: a linked vertex and fragment shader with its uniforms set by name.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "gui/render/gl_handle.h"

namespace palace {

class ShaderProgram {
 public:
  ShaderProgram() = default;
  /// Each stage is the concatenation of its pieces; the first begins with the #version line.
  /// Vertex attributes take their location from the shader text. The error names `name` and holds
  /// the driver's message.
  static Result<ShaderProgram> Build(const std::string& name,
                                     std::initializer_list<std::string_view> vertex_pieces,
                                     std::initializer_list<std::string_view> fragment_pieces);

  void Use() const { glUseProgram(program_.name()); }
  /// The program must be in use. A name the compiler dropped is ignored.
  void Set(const char* name, int value) const;
  void Set(const char* name, float value) const;
  void Set(const char* name, const Eigen::Vector2f& value) const;
  void Set(const char* name, const Eigen::Vector3f& value) const;
  void Set(const char* name, const Eigen::Vector4f& value) const;
  void Set(const char* name, const Eigen::Matrix3f& value) const;
  void Set(const char* name, const Eigen::Matrix4f& value) const;

 private:
  GlProgram program_;
};

}  // namespace palace
