#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/mesh_build.h"
#include "renderer/scene/graph/node_tree.h"
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

/// The joints of a skin in one pose (glTF 2.0, 3.7.3.3), relative to the first joint for precision far from the origin.
struct SkinPose {
  glm::dmat4 worldFromLocal{1};          ///< a translation; mirrored where the first joint mirrors
  std::vector<glm::dmat4> localFromMesh; ///< one a joint
};
SkinPose poseSkin(const Skin& skin, std::span<const glm::dmat4> worldFromNode);

/// Morph targets by `weights` (missing ones 0), then joints (glTF 2.0, 3.7.2.2 and 3.7.3.3). `localFromMesh`: one a
/// joint; empty = no skin.
PosedShape pose(const Deformable& deformable, std::span<const double> weights,
                std::span<const glm::dmat4> localFromMesh);

/// Gives a primitive the vertices of a pose, with its bounds, clusters, welded indices and `solid`.
void applyPose(const PosedShape& shape, int primitive, Scene& scene);

/// The posed primitives of a node's mesh.
struct PosedMesh {
  std::vector<int> followingNode; ///< into Scene::primitives; in the space of the node
  std::vector<int> followingSkin; ///< placed by worldFromSkin
  glm::dmat4 worldFromSkin{1};
};

/// Makes primitives of the deformables of each node's mesh in the rest pose; nodes whose copies can never differ share
/// one. One a node; empty where its mesh has no deformables.
std::vector<PosedMesh> poseNodes(const LoadContext& load, const NodeTree& tree, const std::vector<BuiltMesh>& meshes,
                                 Deformation& deformation, Scene& scene);

} // namespace gnomon
