#pragma once

#include <cstdint>
#include <vector>

#include "renderer/bake/light_map_layout.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A vertex of the scene at one place of a light map.
struct MappedVertex {
  std::uint32_t vertex = 0; ///< of all of the scene's
  glm::vec2 corner{0};      ///< texels

  bool operator==(const MappedVertex&) const = default;
};

/// An instance's triangles, in their order, over vertices that have one place each in a light map.
struct MappedMesh {
  std::vector<MappedVertex> vertices;
  std::vector<std::uint32_t> indices; ///< into them, three a triangle
};

/// `firstCorner`: of the instance, into the layout's corners.
MappedMesh mappedMesh(const Scene& scene, const Primitive& primitive, const LightMapLayout& layout,
                      std::size_t firstCorner);

} // namespace gnomon
