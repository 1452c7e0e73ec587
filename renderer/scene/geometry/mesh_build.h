#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/geometry/triangle_mesh.h"
#include "renderer/scene/known_content.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A mesh of the file, built.
struct BuiltMesh {
  std::vector<int> primitives;  ///< into Scene::primitives
  std::vector<int> deformables; ///< into Deformation::deformables: they become primitives once they are posed
};

/// Fills the scene's vertices, indices, clusters and primitives, and the deformables. Primitives without triangles are
/// left out. A primitive without a material gets the index `defaultMaterial`. What is in `known` is copied from there.
std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, std::vector<Deformable>& deformables, Findings& findings,
                                   KnownContent* known = nullptr);

/// Appends one primitive's vertices, triangles and clusters to the scene; returns its index.
int appendPrimitive(const TriangleMesh& mesh, int material, Scene& scene);

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
