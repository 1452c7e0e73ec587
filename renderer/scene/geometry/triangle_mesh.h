#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace gnomon {

class Findings;
struct PrimitiveSource;

/// The vertices and triangles of one primitive.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<VertexAttributes> attributes; ///< parallel to positions
  std::vector<std::uint32_t> sources;       ///< parallel to positions: the vertex of the accessors that each one was
  std::vector<std::uint32_t> indices;       ///< three a triangle
  bool hasTangents = false;
  bool flat = false; ///< the file has no normals: each triangle has its own three vertices
};

/// Reads a primitive. Without normals it gets flat ones; normals and tangents that have no direction are replaced.
TriangleMesh buildVertices(const PrimitiveSource& source, Findings& findings);

} // namespace gnomon
