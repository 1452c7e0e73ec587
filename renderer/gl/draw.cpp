#include "renderer/gl/draw.h"

namespace gnomon::gl {
namespace {

GLuint makeVertexArray(std::string_view label) {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  setLabel(GL_VERTEX_ARRAY, id, label);
  return id;
}

} // namespace

VertexArray::VertexArray(std::span<const VertexStream> streams, std::span<const VertexAttribute> attributes,
                         const Buffer* indices, std::string_view label)
    : object_(makeVertexArray(label)) {
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const VertexStream& stream = streams[i];
    const auto slot = static_cast<GLuint>(i);
    glVertexArrayVertexBuffer(id(), slot, stream.buffer->id(), static_cast<GLintptr>(stream.offset),
                              static_cast<GLsizei>(stream.stride));
    glVertexArrayBindingDivisor(id(), slot, stream.instanceStep);
  }
  for (const VertexAttribute& attribute : attributes) {
    glEnableVertexArrayAttrib(id(), attribute.location);
    glVertexArrayAttribBinding(id(), attribute.location, attribute.stream);
    if (attribute.integer) {
      glVertexArrayAttribIFormat(id(), attribute.location, attribute.components, attribute.type, attribute.offset);
    } else {
      glVertexArrayAttribFormat(id(), attribute.location, attribute.components, attribute.type,
                                attribute.normalized ? GL_TRUE : GL_FALSE, attribute.offset);
    }
  }
  if (indices) glVertexArrayElementBuffer(id(), indices->id());
}

void drawIndirect(const Program& program, const VertexArray& vertices, const Buffer& commands, std::size_t first,
                  std::size_t count) {
  if (count == 0) return;
  program.use();
  glBindVertexArray(vertices.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * sizeof(DrawCommand)),
                              static_cast<GLsizei>(count), sizeof(DrawCommand));
}

void drawFullscreen(const Program& program, const VertexArray& nothing) {
  program.use();
  glBindVertexArray(nothing.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void submit() {
  glFlush();
}

} // namespace gnomon::gl
