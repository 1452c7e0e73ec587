#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/mesh_build.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The posed primitives of a node's mesh.
struct PosedMesh {
  std::vector<int> followingNode; ///< into Scene::primitives; in the space of the node
  std::vector<int> followingSkin; ///< placed by worldFromSkin
  glm::dmat4 worldFromSkin{1};
};

/// Makes primitives of the deformables of each node's mesh, in the file's rest pose: its node transforms and default
/// weights. Nodes whose copies can never differ share one. One a node; empty where its mesh has no deformables.
std::vector<PosedMesh> poseNodes(const LoadContext& load, const NodeTree& tree, const std::vector<BuiltMesh>& meshes,
                                 Deformation& deformation, Scene& scene);

} // namespace gnomon
