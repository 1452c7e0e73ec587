#include "renderer/scene/graph/node_transform.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace gnomon {

namespace {

NodeTransform readMatrix(const std::vector<double>& m, const std::string& pointer, Findings& findings) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    findings.invalid(pointer + "/matrix", "The matrix is not affine: its last row is not 0 0 0 1.");
    return {};
  }
  glm::dmat4 matrix;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) matrix[column][row] = m[static_cast<std::size_t>(4 * column + row)];
  }
  return {matrix, matrix};
}

} // namespace

void checkTransforms(const nlohmann::json& document, Findings& findings) {
  const auto nodes = document.find("nodes");
  if (nodes == document.end()) return;
  for (std::size_t i = 0; i < nodes->size(); ++i) {
    const nlohmann::json& node = (*nodes)[i];
    if (!node.contains("matrix")) continue;
    if (node.contains("translation") || node.contains("rotation") || node.contains("scale")) {
      findings.invalid(pointerTo("/nodes", i) + "/matrix",
                       "A node has either a matrix or translation, rotation and scale.");
    }
  }
}

NodeTransform readTransform(const tinygltf::Node& node, const std::string& pointer, Findings& findings) {
  if (!node.matrix.empty()) {
    return readMatrix(node.matrix, pointer, findings);
  }
  glm::dmat4 rigid(1);
  if (!node.rotation.empty()) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(rotation);
    if (!(length > 0) || !std::isfinite(length)) {
      findings.invalid(pointer + "/rotation", "The rotation is not a quaternion of length 1.");
      return {};
    }
    rigid = glm::mat4_cast(rotation / length);
  }
  if (!node.translation.empty()) {
    rigid[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
  }
  glm::dmat4 scaled = rigid;
  if (!node.scale.empty()) {
    for (int axis = 0; axis < 3; ++axis) scaled[axis] *= node.scale[static_cast<std::size_t>(axis)];
  }
  return {scaled, rigid};
}

} // namespace gnomon
