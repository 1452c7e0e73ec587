#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Of the points of something the one that lies farthest along a direction (of any length but zero), in the world.
using Farthest = std::function<glm::dvec3(const glm::dvec3& direction)>;

/// Of a box, which is not empty.
Farthest farthestOf(const Aabb& box);

/// Of the vertices of triangles that a camera may see: those of a scene's view whose nodes are visible. Boxes that can
/// hold no farther point are passed over, so that a direction takes little more than a look at each instance.
/// Everything given outlives it; one thread at a time.
class SeenExtent {
 public:
  /// `nodes`: as resolveNodes gives them. `scene` is posed.
  SeenExtent(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes);

  bool empty() const { return bounds_.empty(); }
  const Aabb& bounds() const { return bounds_; } ///< of the boxes of what is seen; empty = nothing is

  /// REQUIRES: not empty.
  glm::dvec3 farthest(const glm::dvec3& direction);

 private:
  const Scene& scene_;
  std::vector<const Instance*> instances_;
  Aabb bounds_;
  std::vector<glm::dvec3> found_; ///< by earlier directions: the next one begins with the best of them
};

} // namespace gnomon
