#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The vertices of a deformable in one pose.
struct PosedShape {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit length
  std::vector<glm::vec4> tangents; ///< w = sign of the bitangent; empty where the mesh has none
  Aabb bounds;                     ///< of the positions; not finite if one of them is not
};

/// The joints of a skin in one pose. Vertices follow their joints, whatever the node that holds the mesh does
/// (glTF 2.0, 3.7.3.3); they are kept relative to the first joint, so that a place far from the origin costs no digits.
struct SkinPose {
  glm::dmat4 worldFromLocal{1};          ///< a translation; mirrored where the first joint mirrors
  std::vector<glm::dmat4> localFromMesh; ///< one a joint
};
SkinPose poseSkin(const Skin& skin, std::span<const glm::dmat4> worldFromNode);

/// Morph targets by their weights, then joints (glTF 2.0, 3.7.2.2 and 3.7.3.3). `weights`: one a target, missing ones
/// 0. `localFromMesh`: one a joint; empty = the deformable keeps to its node.
PosedShape pose(const Deformable& deformable, std::span<const double> weights,
                std::span<const glm::dmat4> localFromMesh);

/// Gives a primitive the vertices of a pose, and what follows from them: bounds, clusters, welded indices, `solid`. Its
/// triangles keep their order.
void applyPose(const PosedShape& shape, int primitive, Scene& scene);

} // namespace gnomon
