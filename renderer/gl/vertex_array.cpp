#include "renderer/gl/vertex_array.h"

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

} // namespace gnomon::gl
