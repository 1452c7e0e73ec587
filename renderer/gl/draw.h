#pragma once

#include <cstdint>

#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"

namespace gnomon::gl {

/// One triangle over the whole viewport, without vertices: the shader makes clip positions from gl_VertexID 0, 1, 2.
/// `nothing` is a vertex array without streams.
void drawFullscreen(const Program& program, const VertexArray& nothing);

/// Hands what was drawn so far to the device, without waiting for it.
void submit();

/// Runs a compute program and makes its writes visible to everything after it.
void dispatch(const Program& program, std::uint32_t groupsX, std::uint32_t groupsY = 1, std::uint32_t groupsZ = 1);

} // namespace gnomon::gl
