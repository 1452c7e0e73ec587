#pragma once

#include <memory>

#include "renderer/frame/frame.h"
#include "renderer/scene/scene.h"

namespace gnomon::testing {

/// A square of ground, and a smaller one that floats a metre above it.
inline std::shared_ptr<const Scene> squares() {
  Scene scene;
  scene.positions = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
  VertexAttributes up;
  up.normal = {0, 1, 0};
  scene.attributes = std::vector<VertexAttributes>(4, up);
  scene.indices = {0, 1, 2, 0, 2, 3};
  scene.welded = scene.indices;
  scene.materials.resize(1);
  scene.primitives.resize(1);
  Primitive& primitive = scene.primitives[0];
  primitive.vertexCount = 4;
  primitive.indexCount = 6;
  primitive.clusterCount = 1;
  for (const glm::vec3& position : scene.positions) primitive.bounds.add(glm::dvec3(position));
  scene.clusters.push_back({primitive.bounds});
  scene.nodes.resize(2);
  SceneView view;
  for (int node = 0; node < 2; ++node) {
    Instance instance;
    instance.node = node;
    if (node == 1) {
      instance.worldFromLocal = glm::dmat4(0.1);
      instance.worldFromLocal[3] = {0, 1, 0, 1};
    }
    instance.bounds = transformed(instance.worldFromLocal, primitive.bounds);
    view.bounds.add(instance.bounds);
    view.instances.push_back(instance);
  }
  view.triangles = 4;
  scene.scenes = {view};
  return std::make_shared<const Scene>(std::move(scene));
}

} // namespace gnomon::testing
