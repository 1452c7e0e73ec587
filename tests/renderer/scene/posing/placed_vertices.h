#pragma once

#include <vector>

#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Where the vertex of the file stands, and its normal there.
struct Placed {
  glm::dvec3 position{0};
  glm::dvec3 normal{0};
};
inline std::vector<Placed> placedVertices(const Scene& scene, std::size_t count) {
  std::vector<Placed> placed(count);
  const Instance& instance = scene.scenes[0].instances.front();
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const TriangleMesh& mesh = scene.deformation->deformables.front().mesh;
  for (std::size_t i = 0; i < primitive.vertexCount; ++i) {
    const glm::dvec4 position(glm::dvec3(scene.positions[primitive.baseVertex + i]), 1);
    placed[mesh.sources[i]] = {glm::dvec3(instance.worldFromLocal * position),
                               glm::dvec3(scene.attributes[primitive.baseVertex + i].normal)};
  }
  return placed;
}

} // namespace gnomon
