#include "renderer/resolve/seen_extent.h"

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

/// The farthest that any point of a box may lie along a direction.
double reachOf(const Aabb& box, const glm::dvec3& direction) {
  return glm::dot(box.center(), direction) + glm::dot(box.halfExtent(), glm::abs(direction));
}

/// The best point so far.
struct Best {
  double reach = -std::numeric_limits<double>::infinity();
  glm::dvec3 point{0};
};

void look(const Scene& scene, const Instance& instance, const glm::dvec3& direction, Best& best) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const glm::dvec3 local = glm::transpose(glm::dmat3(instance.worldFromLocal)) * direction;
  const double offset = glm::dot(glm::dvec3(instance.worldFromLocal[3]), direction);
  constexpr std::uint32_t kClusterIndices = kClusterTriangles * 3;
  for (std::uint32_t cluster = 0; cluster < primitive.clusterCount; ++cluster) {
    if (reachOf(scene.clusters[primitive.firstCluster + cluster].bounds, local) + offset <= best.reach) continue;
    const std::uint32_t begin = cluster * kClusterIndices;
    const std::uint32_t end = std::min(primitive.indexCount, begin + kClusterIndices);
    for (std::uint32_t i = begin; i < end; ++i) {
      const glm::dvec3 vertex(scene.positions[primitive.baseVertex + scene.indices[primitive.firstIndex + i]]);
      const double reach = glm::dot(vertex, local) + offset;
      if (!(reach > best.reach)) continue;
      best = {reach, glm::dvec3(instance.worldFromLocal * glm::dvec4(vertex, 1.0))};
    }
  }
}

} // namespace

Farthest farthestOf(const Aabb& box) {
  return [box](const glm::dvec3& direction) {
    const glm::dvec3 side(direction.x < 0 ? -1 : 1, direction.y < 0 ? -1 : 1, direction.z < 0 ? -1 : 1);
    return box.center() + side * box.halfExtent();
  };
}

SeenExtent::SeenExtent(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes) : scene_(scene) {
  for (const Instance& instance : view.instances) {
    if (!switchesOf(nodes, instance.node).visible) continue;
    instances_.push_back(&instance);
    bounds_.add(instance.bounds);
  }
}

glm::dvec3 SeenExtent::farthest(const glm::dvec3& direction) {
  Best best;
  for (const glm::dvec3& point : found_) {
    const double reach = glm::dot(point, direction);
    if (reach > best.reach) best = {reach, point};
  }
  for (const Instance* instance : instances_) {
    if (reachOf(instance->bounds, direction) > best.reach) look(scene_, *instance, direction, best);
  }
  found_.push_back(best.point);
  return best.point;
}

} // namespace gnomon
