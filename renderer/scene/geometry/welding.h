#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// A triangle list with each vertex replaced by the first one at the same position: what needs nothing but positions
/// runs over fewer vertices so.
std::vector<std::uint32_t> weldedIndices(std::span<const std::uint32_t> indices, std::span<const glm::vec3> positions);

/// The connected piece of each vertex, named by the lowest vertex of the piece: what shares a corner is connected.
std::vector<std::uint32_t> piecesOfVertices(std::span<const std::uint32_t> welded, std::size_t vertexCount);

/// True where the triangles (welded) bound solids: every edge is walked as often one way as the other, and every
/// connected piece has its front faces outside (its volume is not negative). Seen from outside of all of them, the
/// nearest surface is then always a front face.
bool boundsSolids(std::span<const std::uint32_t> welded, std::span<const glm::vec3> positions);

} // namespace gnomon
