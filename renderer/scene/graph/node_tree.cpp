#include "renderer/scene/graph/node_tree.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/aabb.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/scene/reach.h"

namespace gnomon {

namespace {

constexpr double kSmallestSine = 1e-9; ///< below it, two axes count as parallel

/// Of an axis whose scale is 0: nothing that is added to a coordinate, and yet a number with a sign for determinants.
constexpr double kThickness = 1e-30;

/// The matrix with its column of zeros, if it has one, as in withThickness.
glm::dmat4 withThickness(glm::dmat4 matrix) {
  const glm::dmat3 normals = cofactors(glm::dmat3(matrix));
  for (int axis = 0; axis < 3; ++axis) {
    const double area = glm::length(normals[axis]);
    if (glm::dvec3(matrix[axis]) != glm::dvec3(0) || !(area > 0)) continue;
    matrix[axis] = glm::dvec4(kThickness * (normals[axis] / area), 0);
  }
  return matrix;
}

std::vector<int> readParents(const gltf::Model& model, Findings& findings) {
  std::vector<int> parents(model.nodes.size(), -1);
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    const std::vector<int>& children = model.nodes[node].children;
    for (std::size_t i = 0; i < children.size(); ++i) {
      int& parent = parents[static_cast<std::size_t>(children[i])];
      if (parent >= 0) {
        findings.invalid(pointerTo(pointerTo("/nodes", node) + "/children", i),
                         "The node is already a child of another node.", "one parent",
                         "nodes " + std::to_string(parent) + " and " + std::to_string(node));
      }
      parent = static_cast<int>(node);
    }
  }
  return parents;
}

/// The matrix with the last row 0 0 0 1, which it has but for rounding; nothing where it is not affine.
std::optional<glm::dmat4> affine(glm::dmat4 matrix) {
  constexpr double kMatrixRounding = 1e-4;
  for (int column = 0; column < 4; ++column) {
    const double right = column < 3 ? 0 : 1;
    if (!(std::abs(matrix[column].w - right) <= kMatrixRounding)) return std::nullopt;
    matrix[column].w = right;
  }
  return matrix;
}

/// The matrix is affine and the rotation has a length, or there is a problem in the findings.
LocalTransform readTransform(const gltf::Node& node, const std::string& pointer, Findings& findings) {
  LocalTransform local;
  if (node.matrix) {
    local.matrix = affine(*node.matrix);
    if (!local.matrix) {
      findings.invalid(pointer + "/matrix", "The matrix is not affine: its last row is not 0 0 0 1.");
    } else if (*local.matrix != *node.matrix) {
      findings.repair({"The last row of a matrix is 0 0 0 1 but for rounding", "it is read as 0 0 0 1"},
                      pointer + "/matrix");
    }
    return local;
  }
  if (node.rotation) {
    const glm::dquat rotation(node.rotation->w, node.rotation->x, node.rotation->y, node.rotation->z);
    const double length = glm::length(rotation);
    if (!(length > 0) || !std::isfinite(length)) {
      findings.invalid(pointer + "/rotation", "The rotation is not a quaternion of length 1.");
      return {};
    }
    local.rotation = rotation / length;
  }
  if (node.translation) local.translation = *node.translation;
  if (node.scale) local.scale = *node.scale;
  return local;
}

} // namespace

void checkTransforms(const std::vector<gltf::Node>& nodes, Findings& findings) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const gltf::Node& node = nodes[i];
    if (!node.matrix || !(node.translation || node.rotation || node.scale)) continue;
    findings.invalid(pointerTo("/nodes", i) + "/matrix",
                     "A node may have a matrix or translation, rotation and scale, but not both.");
  }
}

glm::dvec3 withThickness(const glm::dvec3& scale) {
  const auto isNothing = [&](int axis) { return std::abs(scale[axis]) < kThickness; };
  if (isNothing(0) + isNothing(1) + isNothing(2) != 1) return scale;
  glm::dvec3 thick = scale;
  for (int axis = 0; axis < 3; ++axis) {
    if (isNothing(axis)) thick[axis] = scale[axis] < 0 ? -kThickness : kThickness;
  }
  return thick;
}

NodeTransform transformOf(const LocalTransform& local) {
  const glm::dvec4 origin(local.origin, 0);
  if (local.matrix) {
    glm::dmat4 matrix = *local.matrix;
    matrix[3] += origin;
    return {withThickness(matrix), matrix};
  }
  glm::dmat4 rigid = glm::mat4_cast(local.rotation);
  rigid[3] = glm::dvec4(local.translation, 1) + origin;
  glm::dmat4 scaled = rigid;
  const glm::dvec3 scale = withThickness(local.scale);
  for (int axis = 0; axis < 3; ++axis) scaled[axis] *= scale[axis];
  return {scaled, rigid};
}

NodePlaces placeNodes(const std::vector<int>& order, const std::vector<int>& parents,
                      const std::vector<LocalTransform>& locals) {
  NodePlaces places{std::vector<glm::dmat4>(locals.size(), glm::dmat4(1)),
                    std::vector<glm::dmat4>(locals.size(), glm::dmat4(1))};
  for (const int index : order) {
    const auto node = static_cast<std::size_t>(index);
    const NodeTransform own = transformOf(locals[node]);
    const int parent = parents[node];
    const glm::dmat4 worldFromParent =
        parent < 0 ? glm::dmat4(1) : places.worldFromNode[static_cast<std::size_t>(parent)];
    places.worldFromNode[node] = worldFromParent * own.parentFromNode;
    places.worldFromUnscaled[node] = worldFromParent * own.parentFromUnscaled;
  }
  return places;
}

std::vector<bool> hiddenNodes(const std::vector<int>& order, const std::vector<int>& parents,
                              const std::vector<bool>& visible) {
  std::vector<bool> hidden(parents.size());
  for (const int index : order) {
    const auto node = static_cast<std::size_t>(index);
    const int parent = parents[node];
    hidden[node] = !visible[node] || (parent >= 0 && hidden[static_cast<std::size_t>(parent)]);
  }
  return hidden;
}

std::vector<PlacedNode> placedNodes(const NodePlaces& places, const std::vector<bool>& hidden) {
  std::vector<PlacedNode> placed;
  placed.reserve(hidden.size());
  for (std::size_t node = 0; node < hidden.size(); ++node) placed.push_back({places.worldFromNode[node], hidden[node]});
  return placed;
}

std::optional<std::size_t> firstLost(const NodePlaces& places, const std::vector<int>& order) {
  for (const int index : order) {
    const auto node = static_cast<std::size_t>(index);
    if (!isWithinReach(places.worldFromNode[node]) || !isWithinReach(places.worldFromUnscaled[node])) return node;
  }
  return std::nullopt;
}

NodeTree buildNodeTree(const gltf::Model& model, Findings& findings) {
  NodeTree tree;
  tree.parents = readParents(model, findings);
  if (findings.refused()) return tree;

  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    if (tree.parents[node] < 0) tree.order.push_back(static_cast<int>(node));
  }
  tree.locals.resize(model.nodes.size());
  tree.visible.resize(model.nodes.size());
  std::vector<bool> reached(model.nodes.size(), false);
  for (std::size_t i = 0; i < tree.order.size(); ++i) {
    const auto node = static_cast<std::size_t>(tree.order[i]);
    reached[node] = true;
    tree.locals[node] = readTransform(model.nodes[node], pointerTo("/nodes", node), findings);
    if (tree.parents[node] < 0) tree.locals[node].origin = model.center;
    tree.visible[node] = model.nodes[node].visible;
    const std::vector<int>& children = model.nodes[node].children;
    tree.order.insert(tree.order.end(), children.begin(), children.end());
  }
  tree.hidden = hiddenNodes(tree.order, tree.parents, tree.visible);
  static_cast<NodePlaces&>(tree) = placeNodes(tree.order, tree.parents, tree.locals);
  if (const auto lost = firstLost(tree, tree.order)) {
    findings.invalid(pointerTo("/nodes", *lost), "The node's world transform places it, or stretches it, too far.",
                     reachLimit(), nodeTitle(*lost, model.nodes[*lost].name));
    return tree;
  }
  for (std::size_t node = 0; node < reached.size(); ++node) {
    if (!reached[node]) findings.invalid(pointerTo("/nodes", node), "The node is its own ancestor.");
  }
  return tree;
}

bool frameOf(const glm::dmat4& worldFromUnscaled, NodeFrame& frame) {
  frame.position = glm::dvec3(worldFromUnscaled[3]);
  const double depth = glm::length(glm::dvec3(worldFromUnscaled[2]));
  const double height = glm::length(glm::dvec3(worldFromUnscaled[1]));
  if (!(depth > 0) || !(height > 0) || !std::isfinite(depth) || !std::isfinite(height)) return false;
  frame.forward = glm::dvec3(worldFromUnscaled[2]) / -depth;
  const glm::dvec3 side = glm::cross(frame.forward, glm::dvec3(worldFromUnscaled[1]) / height);
  const double sine = glm::length(side);
  if (!(sine > kSmallestSine)) return false;
  frame.right = side / sine;
  frame.up = glm::cross(frame.right, frame.forward);
  return true;
}

} // namespace gnomon
