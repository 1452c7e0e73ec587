#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/mesh_edges.h"

namespace gnomon {

/// What a primitive's outline is told from.
struct EdgeMesh {
  std::vector<MeshEdge> edges;
  std::vector<glm::vec3> normals; ///< one a triangle, in the primitive's own space, unit length; 0 where it has no area
};

/// One a primitive of the scene.
std::vector<EdgeMesh> edgeMeshes(const Scene& scene);

std::size_t bytesOf(const std::vector<EdgeMesh>& meshes);

} // namespace gnomon
