#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"

namespace gnomon::gl {

/// One draw of an indexed triangle list, as glMultiDrawElementsIndirect reads it.
struct DrawCommand {
  std::uint32_t indexCount = 0;
  std::uint32_t instanceCount = 1;
  std::uint32_t firstIndex = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t baseInstance = 0; ///< where streams with an instance step begin
};

/// Draws `count` of the commands in `commands` from number `first` on, with one call. Nothing when count is 0.
void drawIndirect(const Program& program, const VertexArray& vertices, const Buffer& commands, std::size_t first,
                  std::size_t count);

} // namespace gnomon::gl
