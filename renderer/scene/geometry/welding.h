#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"

namespace gnomon {

/// A triangle list with each vertex replaced by the first one at the same position.
std::vector<std::uint32_t> weldedIndices(std::span<const std::uint32_t> indices, std::span<const glm::vec3> positions);

/// The connected piece of each vertex, named by the lowest vertex of the piece: what shares a corner is connected.
std::vector<std::uint32_t> piecesOfVertices(std::span<const std::uint32_t> welded, std::size_t vertexCount);

/// Whether the triangles (welded) bound solids with front faces outside: every edge is walked as often both ways, and
/// no connected piece has a negative volume.
bool boundsSolids(std::span<const std::uint32_t> welded, std::span<const glm::vec3> positions);

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// An edge of a primitive, vertices of equal position taken for one.
struct MeshEdge {
  std::uint32_t from = 0; ///< welded vertices (Scene::welded), relative to the primitive's baseVertex
  std::uint32_t to = 0;
  std::uint32_t left = kNoTriangle;  ///< triangle of the primitive that runs from -> to
  std::uint32_t right = kNoTriangle; ///< the one that runs to -> from; kNoTriangle = the edge is open
};

/// Every edge of a primitive, sorted by the lower vertex, then the higher one; once for each pair of triangles that run
/// along it in opposite ways, and once for each other triangle. Triangles with two corners at one place have none.
std::vector<MeshEdge> meshEdges(const Scene& scene, const Primitive& primitive);

} // namespace gnomon
