#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A node's own transform in the parts that animations move.
struct LocalTransform {
  std::optional<glm::dmat4> matrix; ///< instead of the others
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0}; ///< of length 1
  glm::dvec3 scale{1};
  glm::dvec3 origin{0}; ///< what the node is moved by in its parent, wherever it is: CESIUM_RTC
};

/// A node's own transform as matrices.
struct NodeTransform {
  glm::dmat4 parentFromNode{1};
  glm::dmat4 parentFromUnscaled{1}; ///< without its scale; a node with a `matrix` keeps it
};

NodeTransform transformOf(const LocalTransform& local);

/// A scale with at most a tiny thickness instead of one axis of 0, so that a surface keeps its front side.
glm::dvec3 withThickness(const glm::dvec3& scale);

/// Refuses nodes that have a matrix beside a translation, rotation or scale.
void checkTransforms(const std::vector<gltf::Node>& nodes, Findings& findings);

/// The places of all nodes.
struct NodePlaces {
  std::vector<glm::dmat4> worldFromNode;
  std::vector<glm::dmat4> worldFromUnscaled; ///< without the node's own scale: what cameras and lights go by
};

/// `order`: the nodes, parents before children. `parents`: -1 for a root.
NodePlaces placeNodes(const std::vector<int>& order, const std::vector<int>& parents,
                      const std::vector<LocalTransform>& locals);

/// The first node in that order whose place is not within reach.
std::optional<std::size_t> firstLost(const NodePlaces& places, const std::vector<int>& order);

/// Which nodes are hidden with what is above them. `visible`: each by itself.
std::vector<bool> hiddenNodes(const std::vector<int>& order, const std::vector<int>& parents,
                              const std::vector<bool>& visible);

/// Both parallel to the nodes.
std::vector<PlacedNode> placedNodes(const NodePlaces& places, const std::vector<bool>& hidden);

/// The nodes in the file's rest pose.
struct NodeTree : NodePlaces {
  std::vector<int> parents; ///< -1 for a root
  std::vector<int> order;   ///< parents before children
  std::vector<LocalTransform> locals;
  std::vector<bool> visible; ///< what KHR_node_visibility says of each node itself
  std::vector<bool> hidden;  ///< the node or one above it is not visible
};

/// The tree and its matrices. Problems, after which the result is unusable: nodes that form no tree, matrices that are
/// not affine, rotations of length 0, places beyond reach.
NodeTree buildNodeTree(const gltf::Model& model, Findings& findings);

/// The axes of a node, orthonormal whatever scales it; false where the matrix leaves none.
struct NodeFrame {
  glm::dvec3 position{0};
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 forward{0, 0, -1}; ///< the node's -Z
};
bool frameOf(const glm::dmat4& worldFromUnscaled, NodeFrame& frame);

/// Repairs scenes that list a child of another node: the child is drawn once, below its parent where a scene has that
/// one, else as a root.
void settleSceneRoots(gltf::Model& model, const Limits& limits, Findings& findings);

/// Repairs skins whose joints stand in several trees, or in no scene although their mesh is in one. `order`: parents
/// before children.
void checkSkinRoots(const gltf::Model& model, const std::vector<int>& parents, const std::vector<int>& order,
                    Findings& findings);

} // namespace gnomon
