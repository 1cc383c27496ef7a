// MeshBuffer: triangles on the graphics device, how their corners are laid out, and in what order
// they are drawn: three by three, or as an index says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gui/render/gl_handle.h"

namespace palace {

struct MeshBuffer {
  GlVertexArray array;
  GlBuffer buffer;
  GlBuffer index;
  GLsizei count = 0;  ///< corners drawn: of the index, where there is one

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
  void Index(const std::vector<std::uint32_t>& corners) {
    index = GlBuffer::Create();
    count = static_cast<GLsizei>(corners.size());
    glBindVertexArray(array.name());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(corners.size() * sizeof(std::uint32_t)), corners.data(),
                 GL_STATIC_DRAW);
  }
  void Draw() const {
    if (count > 0 && index) {
      glBindVertexArray(array.name());
      glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
    } else if (count > 0) {
      glBindVertexArray(array.name());
      glDrawArrays(GL_TRIANGLES, 0, count);
    }
  }
  /// Runs of the index: how many corners from which on.
  void DrawRuns(const std::vector<GLsizei>& counts, const std::vector<std::size_t>& firsts) const {
    std::vector<const void*> offsets;
    for (const std::size_t first : firsts) {
      offsets.push_back(reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
    }
    glBindVertexArray(array.name());
    glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                        static_cast<GLsizei>(counts.size()));
  }
};

}  // namespace palace
