#include "renderer/scene/edge_mesh.h"

#include <algorithm>
#include <numeric>

namespace gnomon {
namespace {

glm::vec3 normalOf(const Scene& scene, const Primitive& primitive, std::uint32_t triangle) {
  const auto corner = [&](std::uint32_t i) {
    return glm::dvec3(scene.positions[primitive.baseVertex + scene.indices[primitive.firstIndex + 3 * triangle + i]]);
  };
  const glm::dvec3 area = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
  const double length = glm::length(area);
  return length > 0 ? glm::vec3(area / length) : glm::vec3(0.0f);
}

} // namespace

std::vector<EdgeMesh> edgeMeshes(const Scene& scene) {
  std::vector<EdgeMesh> meshes(scene.primitives.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Primitive& primitive = scene.primitives[i];
    meshes[i].edges = meshEdges(scene, primitive);
    meshes[i].normals.resize(primitive.indexCount / 3);
    for (std::uint32_t triangle = 0; triangle < meshes[i].normals.size(); ++triangle) {
      meshes[i].normals[triangle] = normalOf(scene, primitive, triangle);
    }
  }
  return meshes;
}

std::size_t bytesOf(const std::vector<EdgeMesh>& meshes) {
  return std::accumulate(meshes.begin(), meshes.end(), std::size_t{0}, [](std::size_t sum, const EdgeMesh& mesh) {
    return sum + mesh.edges.size() * sizeof(MeshEdge) + mesh.normals.size() * sizeof(glm::vec3);
  });
}

} // namespace gnomon
