#include "renderer/scene/ground.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>

namespace gnomon {
namespace {

Material materialOfGround(const GroundPlane& ground) {
  Material material;
  material.name = "ground";
  material.baseColorFactor = glm::vec4(ground.color, 1);
  material.metallicFactor = 0;
  material.roughnessFactor = ground.roughness;
  material.catchesShadows = ground.catchesShadows;
  return material;
}

void addTo(SceneView& view, const Instance& ground, std::uint32_t triangles) {
  view.instances.push_back(ground);
  view.triangles += triangles;
}

} // namespace

void addGroundMesh(Scene& scene) {
  constexpr std::array<glm::vec3, 4> kCorners{{{-0.5, 0, -0.5}, {-0.5, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0, -0.5}}};
  constexpr std::array<std::uint32_t, 6> kTriangles{0, 1, 2, 0, 2, 3};
  Primitive square;
  square.baseVertex = static_cast<std::uint32_t>(scene.positions.size());
  square.vertexCount = kCorners.size();
  square.firstIndex = static_cast<std::uint32_t>(scene.indices.size());
  square.indexCount = kTriangles.size();
  square.firstCluster = static_cast<std::uint32_t>(scene.clusters.size());
  square.clusterCount = 1;
  square.content = "ground";
  for (const glm::vec3& corner : kCorners) {
    scene.positions.edit().push_back(corner);
    scene.attributes.edit().push_back(VertexAttributes{.normal{0, 1, 0}, .uv0{corner.x, corner.z}});
    square.bounds.add(glm::dvec3(corner));
  }
  for (auto* indices : {&scene.indices, &scene.welded}) {
    indices->edit().insert(indices->edit().end(), kTriangles.begin(), kTriangles.end());
  }
  scene.clusters.push_back({square.bounds});
  scene.groundMesh = square;
}

std::shared_ptr<const Scene> groundedScene(const Scene& posed, const GroundPlane& ground) {
  auto scene = std::make_shared<Scene>(posed);
  scene->motion.reset();
  scene->poses.reset();
  if (!scene->groundMesh) addGroundMesh(*scene);
  scene->ground = ground;

  Primitive square = *scene->groundMesh;
  square.material = static_cast<int>(scene->materials.size());
  scene->materials.push_back(materialOfGround(ground));
  Instance instance;
  instance.node = static_cast<int>(scene->nodes.size());
  instance.primitive = static_cast<int>(scene->primitives.size());
  instance.worldFromLocal =
      glm::scale(glm::translate(glm::dmat4(1), ground.center), glm::dvec3(ground.size, 1, ground.size));
  instance.bounds = transformed(instance.worldFromLocal, square.bounds);
  for (SceneView& view : scene->scenes) addTo(view, instance, square.indexCount / 3);
  scene->primitives.push_back(std::move(square));
  scene->nodes.push_back({"ground"});
  if (!scene->placedNodes.empty()) scene->placedNodes.emplace_back();
  return scene;
}

} // namespace gnomon
