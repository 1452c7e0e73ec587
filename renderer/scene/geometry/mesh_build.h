#pragma once

#include <vector>

#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A mesh of the file, built.
struct BuiltMesh {
  std::vector<int> primitives; ///< into Scene::primitives
  std::uint64_t triangles = 0; ///< of one placement
};

/// Fills the scene's vertices, indices, clusters and primitives. Primitives without triangles are left out.
/// A primitive without a material gets the index `defaultMaterial`.
std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, Findings& findings);

} // namespace gnomon
