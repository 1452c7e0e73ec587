#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/shared_content.h"

namespace gnomon {

/// A mesh of the file, built.
struct BuiltMesh {
  std::vector<int> primitives;  ///< into Scene::primitives
  std::vector<int> deformables; ///< into Deformation::deformables: they become primitives once they are posed
};

/// Fills the scene's vertices, indices, clusters and primitives, and the deformables; copies what is in `known`. Leaves
/// out primitives without triangles; `defaultMaterial` is the material of those without one.
std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, std::vector<Deformable>& deformables, Findings& findings,
                                   KnownContent* known = nullptr);

/// Appends one primitive's vertices, triangles and clusters to the scene; returns its index.
int appendPrimitive(const TriangleMesh& mesh, int material, Scene& scene);

/// The triangles in spatial order; a pure function.
std::vector<std::uint32_t> spatiallySorted(std::vector<std::uint32_t> indices, std::span<const glm::vec3> positions);

/// The clusters of a triangle list: every kClusterTriangles of it, with the box around them.
std::vector<Cluster> clustersOf(std::span<const std::uint32_t> indices, std::span<const glm::vec3> positions);

/// The same triangles in clusters of neighbors, ordered for vertex caches, vertices as they are first used; a pure
/// function.
TriangleMesh ordered(TriangleMesh mesh);

} // namespace gnomon
