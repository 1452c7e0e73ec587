#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/geometry/mesh_source.h"

namespace gnomon {

/// The corners of a primitive's triangles, three after three, as vertices of its accessors; strips and fans are
/// unrolled with the winding that glTF 2.0, 3.7.2.1 gives them. Every corner is below positions->count, or there is
/// a problem in the findings and the list is empty.
std::vector<std::uint32_t> readTriangles(const PrimitiveSource& source, Findings& findings);

/// Drops triangles with a corner that is not finite, with a warning, and those without an area, unless a pose may give
/// them one.
void dropUndrawable(std::vector<std::uint32_t>& corners, const PrimitiveSource& source, Findings& findings);

/// The vertices that the corners use, ascending; the corners become indices into them.
std::vector<std::uint32_t> compactVertices(std::vector<std::uint32_t>& corners, std::size_t vertexCount);

} // namespace gnomon
