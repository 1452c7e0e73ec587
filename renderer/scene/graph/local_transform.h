#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace gnomon {

/// A node's own transform in the parts that animations move.
struct LocalTransform {
  std::optional<glm::dmat4> matrix; ///< instead of the others
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0}; ///< of length 1
  glm::dvec3 scale{1};
};

/// A node's own transform as matrices.
struct NodeTransform {
  glm::dmat4 parentFromNode{1};
  glm::dmat4 parentFromUnscaled{1}; ///< without its scale; a node with a `matrix` keeps it
};

inline NodeTransform transformOf(const LocalTransform& local) {
  if (local.matrix) return {*local.matrix, *local.matrix};
  glm::dmat4 rigid = glm::mat4_cast(local.rotation);
  rigid[3] = glm::dvec4(local.translation, 1);
  glm::dmat4 scaled = rigid;
  for (int axis = 0; axis < 3; ++axis) scaled[axis] *= local.scale[axis];
  return {scaled, rigid};
}

} // namespace gnomon
