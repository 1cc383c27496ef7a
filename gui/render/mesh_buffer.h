// MeshBuffer: triangles on the graphics device, and how their corners are laid out.
#pragma once

#include <cstddef>

#include "gui/render/gl_handle.h"

namespace palace {

struct MeshBuffer {
  GlVertexArray array;
  GlBuffer buffer;
  GLsizei count = 0;

  void Start(const void* data, std::size_t bytes, std::size_t vertices) {
    array = GlVertexArray::Create();
    buffer = GlBuffer::Create();
    count = static_cast<GLsizei>(vertices);
    glBindVertexArray(array.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  }
  void Attribute(GLuint location, int floats, std::size_t stride, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, floats, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                          reinterpret_cast<const void*>(offset));
  }
  void Draw() const {
    if (count > 0) {
      glBindVertexArray(array.name());
      glDrawArrays(GL_TRIANGLES, 0, count);
    }
  }
};

}  // namespace palace
