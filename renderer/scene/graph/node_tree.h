#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/findings.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/graph/local_transform.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Where every node stands, whichever scene it belongs to.
struct NodePlaces {
  std::vector<glm::dmat4> worldFromNode;
  std::vector<glm::dmat4> worldFromUnscaled; ///< without the node's own scale: what cameras and lights go by
};

/// `order`: the nodes, parents before children. `parents`: -1 for a root.
NodePlaces placeNodes(const std::vector<int>& order, const std::vector<int>& parents,
                      const std::vector<LocalTransform>& locals);

/// The first node in that order whose place is not finite.
std::optional<std::size_t> firstLost(const NodePlaces& places, const std::vector<int>& order);

/// Which nodes are hidden with what is above them. `visible`: each by itself.
std::vector<bool> hiddenNodes(const std::vector<int>& order, const std::vector<int>& parents,
                              const std::vector<bool>& visible);

/// The nodes in the file's rest pose.
struct NodeTree : NodePlaces {
  std::vector<int> parents; ///< -1 for a root
  std::vector<int> order;   ///< parents before children
  std::vector<LocalTransform> locals;
  std::vector<bool> visible; ///< what KHR_node_visibility says of each node itself
  std::vector<bool> hidden;  ///< the node or one above it is not visible
};

/// Checks that the nodes form trees and that scenes name roots of them, and computes the matrices.
/// With a problem in the findings, the result is not to be used.
NodeTree buildNodeTree(const GltfDocument& document, Findings& findings);

/// Names and parents of the nodes, which have been found to be trees.
std::vector<SceneNode> namedNodes(const tinygltf::Model& model);

/// The axes of a node, orthonormal whatever scales it; false where the matrix leaves none.
struct NodeFrame {
  glm::dvec3 position{0};
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 forward{0, 0, -1}; ///< the node's -Z
};
bool frameOf(const glm::dmat4& worldFromUnscaled, NodeFrame& frame);

} // namespace gnomon
