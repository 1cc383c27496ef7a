#include "gui/render/shader.h"

#include <vector>

namespace palace {
namespace {

Result<GlShader> Compile(const std::string& name, GLenum stage,
                         std::initializer_list<std::string_view> pieces) {
  GlShader shader = GlShader::Adopt(glCreateShader(stage));
  std::vector<const GLchar*> texts;
  std::vector<GLint> lengths;
  for (const std::string_view piece : pieces) {
    texts.push_back(piece.data());
    lengths.push_back(static_cast<GLint>(piece.size()));
  }
  glShaderSource(shader.name(), static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
  glCompileShader(shader.name());
  GLint compiled = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == 0) {
    char text[2048] = {};
    glGetShaderInfoLog(shader.name(), sizeof text, nullptr, text);
    return UnavailableError("shader " + name +
                            " does not compile with this OpenGL driver: " + text);
  }
  return shader;
}

}  // namespace

Result<ShaderProgram> ShaderProgram::Build(
    const std::string& name, std::initializer_list<std::string_view> vertex_pieces,
    std::initializer_list<std::string_view> fragment_pieces) {
  Result<GlShader> vertex = Compile(name + " (vertex)", GL_VERTEX_SHADER, vertex_pieces);
  if (!vertex) {
    return vertex.error();
  }
  Result<GlShader> fragment = Compile(name + " (fragment)", GL_FRAGMENT_SHADER, fragment_pieces);
  if (!fragment) {
    return fragment.error();
  }
  ShaderProgram program;
  program.program_ = GlProgram::Adopt(glCreateProgram());
  const GLuint id = program.program_.name();
  glAttachShader(id, vertex->name());
  glAttachShader(id, fragment->name());
  glLinkProgram(id);
  GLint linked = 0;
  glGetProgramiv(id, GL_LINK_STATUS, &linked);
  if (linked == 0) {
    char text[2048] = {};
    glGetProgramInfoLog(id, sizeof text, nullptr, text);
    return UnavailableError("shader " + name + " does not link with this OpenGL driver: " + text);
  }
  return program;
}

void ShaderProgram::Set(const char* name, int value) const {
  glUniform1i(glGetUniformLocation(program_.name(), name), value);
}
void ShaderProgram::Set(const char* name, float value) const {
  glUniform1f(glGetUniformLocation(program_.name(), name), value);
}
void ShaderProgram::Set(const char* name, const Eigen::Vector2f& value) const {
  glUniform2fv(glGetUniformLocation(program_.name(), name), 1, value.data());
}
void ShaderProgram::Set(const char* name, const Eigen::Vector3f& value) const {
  glUniform3fv(glGetUniformLocation(program_.name(), name), 1, value.data());
}
void ShaderProgram::Set(const char* name, const Eigen::Vector4f& value) const {
  glUniform4fv(glGetUniformLocation(program_.name(), name), 1, value.data());
}
void ShaderProgram::Set(const char* name, const Eigen::Matrix3f& value) const {
  glUniformMatrix3fv(glGetUniformLocation(program_.name(), name), 1, GL_FALSE, value.data());
}
void ShaderProgram::Set(const char* name, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(glGetUniformLocation(program_.name(), name), 1, GL_FALSE, value.data());
}

}  // namespace palace
