#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/geometry/triangle_mesh.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Orders a triangle list so that triangles near each other in space are near each other in the list.
/// The result depends on nothing but the arguments.
std::vector<std::uint32_t> spatiallySorted(std::vector<std::uint32_t> indices, std::span<const glm::vec3> positions);

/// The clusters of a triangle list: every kClusterTriangles of it, with the box around them.
std::vector<Cluster> clustersOf(std::span<const std::uint32_t> indices, std::span<const glm::vec3> positions);

/// The same triangles in the order that a device draws fast: clusters of triangles that lie near each other, those of a
/// cluster one after the other as their vertices are shared, and vertices as they are first used. The result depends on
/// nothing but the mesh.
TriangleMesh ordered(TriangleMesh mesh);

} // namespace gnomon
