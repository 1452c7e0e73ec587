#include "renderer/scene/geometry/mesh_build.h"

#include "renderer/scene/geometry/clusters.h"
#include "renderer/scene/geometry/triangle_mesh.h"
#include "renderer/scene/geometry/welding.h"
#include "renderer/scene/posing/deformation.h"

namespace gnomon {

namespace {

void giveVertexColors(const PrimitiveSource& source, int material, std::vector<Material>& materials) {
  materials[static_cast<std::size_t>(material)].hasVertexColors = true;
  for (const int other : source.variantMaterials) {
    if (other >= 0) materials[static_cast<std::size_t>(other)].hasVertexColors = true;
  }
}

} // namespace

int appendPrimitive(const TriangleMesh& mesh, int material, Scene& scene) {
  const std::vector<Cluster> clusters = clustersOf(mesh.indices, mesh.positions);
  const std::vector<std::uint32_t> welded = weldedIndices(mesh.indices, mesh.positions);

  Primitive primitive;
  primitive.material = material;
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
  scene.primitives.push_back(primitive);
  return static_cast<int>(scene.primitives.size()) - 1;
}

std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, std::vector<Deformable>& deformables, Findings& findings) {
  std::vector<BuiltMesh> built(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const PrimitiveSource& source : meshes[m]) {
      TriangleMesh mesh = ordered(buildVertices(source, findings));
      if (mesh.indices.empty()) continue;
      const int material = source.material >= 0 ? source.material : defaultMaterial;
      if (source.colors) giveVertexColors(source, material, scene.materials);
      if (source.deforms()) {
        built[m].deformables.push_back(static_cast<int>(deformables.size()));
        deformables.push_back(buildDeformable(source, std::move(mesh), findings));
        deformables.back().material = material;
        deformables.back().variantMaterials = source.variantMaterials;
      } else {
        built[m].primitives.push_back(appendPrimitive(mesh, material, scene));
        scene.primitives.back().variantMaterials = source.variantMaterials;
      }
    }
  }
  return built;
}

} // namespace gnomon
