#pragma once

#include <vector>

#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A mesh of the file, built.
struct BuiltMesh {
  std::vector<int> primitives;  ///< into Scene::primitives
  std::vector<int> deformables; ///< into Deformation::deformables: they become primitives once they are posed
};

/// Fills the scene's vertices, indices, clusters and primitives, and the deformables. Primitives without triangles are
/// left out. A primitive without a material gets the index `defaultMaterial`.
std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, std::vector<Deformable>& deformables, Findings& findings);

/// Appends one primitive's vertices, triangles and clusters to the scene; returns its index.
int appendPrimitive(const TriangleMesh& mesh, int material, Scene& scene);

} // namespace gnomon
