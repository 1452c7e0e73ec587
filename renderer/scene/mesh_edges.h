#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "renderer/scene/scene.h"

namespace gnomon {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// An edge of a primitive, vertices of equal position taken for one.
struct MeshEdge {
  std::uint32_t from = 0; ///< welded vertices (Scene::welded), relative to the primitive's baseVertex
  std::uint32_t to = 0;
  std::uint32_t left = kNoTriangle;  ///< triangle of the primitive that runs from -> to
  std::uint32_t right = kNoTriangle; ///< the one that runs to -> from; kNoTriangle = the edge is open
};

/// Every edge of a primitive, once for each pair of triangles that run along it in opposite ways; a triangle that finds
/// no partner there has the edge alone. Triangles with two corners at one place have none; those whose corners lie on
/// one line keep theirs, so that they leave no gap in what is closed. Sorted by the lower vertex, then the higher one.
std::vector<MeshEdge> meshEdges(const Scene& scene, const Primitive& primitive);

} // namespace gnomon
