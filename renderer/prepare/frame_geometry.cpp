#include "renderer/prepare/frame_geometry.h"

#include <algorithm>

#include "renderer/core/linear_algebra.h"

namespace gnomon {
namespace {

glm::dmat3 normalFromLocal(const glm::dmat3& linear) {
  glm::dmat3 normals = normalMatrix(linear);
  const double size = std::max({glm::length(normals[0]), glm::length(normals[1]), glm::length(normals[2])});
  if (size > 0) normals /= size;
  return normals;
}

} // namespace

FrameGeometry frameGeometry(const Scene& scene, const SceneView& view, const glm::dvec3& eye,
                            std::span<const std::uint8_t> groups) {
  FrameGeometry geometry;
  geometry.instances.reserve(view.instances.size());
  geometry.firstSlot.reserve(view.instances.size() + 1);
  geometry.firstSlot.push_back(0);
  for (const Instance& instance : view.instances) {
    glm::dmat4 relativeFromLocal = instance.worldFromLocal;
    relativeFromLocal[3] -= glm::dvec4(eye, 0.0);
    const std::uint8_t group = groups.empty() ? std::uint8_t{0} : groups[geometry.instances.size()];
    geometry.instances.push_back(
        {relativeFromLocal, normalFromLocal(glm::dmat3(relativeFromLocal)), instance.node, group});
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    for (std::uint32_t i = 0; i < primitive.clusterCount; ++i) {
      geometry.slotBounds.push_back(transformed(relativeFromLocal, scene.clusters[primitive.firstCluster + i].bounds));
    }
    geometry.firstSlot.push_back(static_cast<std::uint32_t>(geometry.slotBounds.size()));
  }
  return geometry;
}

void keepNodes(std::span<const NodeSwitches> nodes, const SceneView& view, const FrameGeometry& geometry,
               const std::function<bool(const NodeSwitches&)>& pass, std::vector<std::uint8_t>& slots) {
  if (nodes.empty() && pass(NodeSwitches{})) return;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    if (pass(switchesOf(nodes, view.instances[i].node))) continue;
    std::fill(slots.begin() + geometry.firstSlot[i], slots.begin() + geometry.firstSlot[i + 1], 0);
  }
}

} // namespace gnomon
