#include "renderer/scene/geometry/mesh_build.h"

#include "renderer/scene/geometry/clusters.h"
#include "renderer/scene/geometry/vertex_build.h"
#include "renderer/scene/geometry/welding.h"

namespace gnomon {

namespace {

/// Appends one primitive's vertices, triangles and clusters to the scene.
Primitive append(TriangleMesh mesh, Scene& scene) {
  mesh.indices = spatiallySorted(std::move(mesh.indices), mesh.positions);
  const std::vector<Cluster> clusters = clustersOf(mesh.indices, mesh.positions);
  const std::vector<std::uint32_t> welded = weldedIndices(mesh.indices, mesh.positions);

  Primitive primitive;
  primitive.baseVertex = static_cast<std::uint32_t>(scene.positions.size());
  primitive.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  primitive.firstIndex = static_cast<std::uint32_t>(scene.indices.size());
  primitive.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
  primitive.firstCluster = static_cast<std::uint32_t>(scene.clusters.size());
  primitive.clusterCount = static_cast<std::uint32_t>(clusters.size());
  primitive.hasTangents = mesh.hasTangents;
  primitive.solid = boundsSolids(welded, mesh.positions);
  for (const Cluster& cluster : clusters) primitive.bounds.add(cluster.bounds);

  scene.positions.insert(scene.positions.end(), mesh.positions.begin(), mesh.positions.end());
  scene.attributes.insert(scene.attributes.end(), mesh.attributes.begin(), mesh.attributes.end());
  scene.indices.insert(scene.indices.end(), mesh.indices.begin(), mesh.indices.end());
  scene.welded.insert(scene.welded.end(), welded.begin(), welded.end());
  scene.clusters.insert(scene.clusters.end(), clusters.begin(), clusters.end());
  return primitive;
}

} // namespace

std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, Findings& findings) {
  std::vector<BuiltMesh> built(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const PrimitiveSource& source : meshes[m]) {
      TriangleMesh mesh = buildVertices(source, findings);
      if (mesh.indices.empty()) continue;
      Primitive primitive = append(std::move(mesh), scene);
      primitive.material = source.material >= 0 ? source.material : defaultMaterial;
      if (source.colors) scene.materials[static_cast<std::size_t>(primitive.material)].hasVertexColors = true;
      built[m].primitives.push_back(static_cast<int>(scene.primitives.size()));
      built[m].triangles += primitive.indexCount / 3;
      scene.primitives.push_back(primitive);
    }
  }
  return built;
}

} // namespace gnomon
