#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "tests/support/glb_builder.h"

namespace gnomon::testing {

/// A closed surface with normals and texture coordinates.
struct Shape {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texCoords;
  std::vector<std::uint32_t> indices;
};

/// A torus around Y of radii 2 and 0.75: segments x segments quads.
Shape torus(int segments);

/// The shape as mesh 0 at node 0, written in different ways.
GlbBuilder plainModel(const Shape& shape);
GlbBuilder quantizedModel(const Shape& shape); ///< KHR_mesh_quantization: 16-bit positions, 8-bit normals
GlbBuilder dracoModel(const Shape& shape, bool edgebreaker = true);
GlbBuilder meshoptModel(const Shape& shape, const std::string& name = "EXT_meshopt_compression");

} // namespace gnomon::testing
