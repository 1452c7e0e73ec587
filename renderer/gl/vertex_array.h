#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "renderer/gl/buffer.h"
#include "renderer/gl/object.h"

namespace gnomon::gl {

/// A buffer that vertices (or instances) are read from.
struct VertexStream {
  const Buffer* buffer = nullptr;
  std::size_t stride = 0;  ///< bytes from one vertex to the next
  std::size_t offset = 0;  ///< bytes before the first
  GLuint instanceStep = 0; ///< 0 = one a vertex, n = one every n instances
};

/// One shader input.
struct VertexAttribute {
  GLuint location = 0;
  GLuint stream = 0; ///< index into the streams
  int components = 4;
  GLenum type = GL_FLOAT;
  bool normalized = false; ///< integers become 0..1 or -1..1
  bool integer = false;    ///< integers stay integers (uint/int inputs)
  GLuint offset = 0;       ///< bytes from the start of the vertex
};

/// Where a draw reads its vertices and its 32-bit indices. The buffers outlive it.
class VertexArray {
 public:
  VertexArray() = default;
  VertexArray(std::span<const VertexStream> streams, std::span<const VertexAttribute> attributes, const Buffer* indices,
              std::string_view label);

  GLuint id() const { return object_.get(); }

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteVertexArrays(1, &id); }
  };
  Object<Delete{}> object_;
};

} // namespace gnomon::gl
