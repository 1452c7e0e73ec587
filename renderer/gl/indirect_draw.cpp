#include "renderer/gl/indirect_draw.h"

namespace gnomon::gl {

void drawIndirect(const Program& program, const VertexArray& vertices, const Buffer& commands, std::size_t first,
                  std::size_t count) {
  if (count == 0) return;
  program.use();
  glBindVertexArray(vertices.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * sizeof(DrawCommand)),
                              static_cast<GLsizei>(count), sizeof(DrawCommand));
}

} // namespace gnomon::gl
