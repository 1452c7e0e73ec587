#include "renderer/scene/graph/node_transform.h"

#include <cmath>

namespace gnomon {

namespace {

LocalTransform readMatrix(const std::vector<double>& m, const std::string& pointer, Findings& findings) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    findings.invalid(pointer + "/matrix", "The matrix is not affine: its last row is not 0 0 0 1.");
    return {};
  }
  glm::dmat4 matrix;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) matrix[column][row] = m[static_cast<std::size_t>(4 * column + row)];
  }
  LocalTransform local;
  local.matrix = matrix;
  return local;
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

LocalTransform readTransform(const tinygltf::Node& node, const std::string& pointer, Findings& findings) {
  if (!node.matrix.empty()) return readMatrix(node.matrix, pointer, findings);
  LocalTransform local;
  if (!node.rotation.empty()) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(rotation);
    if (!(length > 0) || !std::isfinite(length)) {
      findings.invalid(pointer + "/rotation", "The rotation is not a quaternion of length 1.");
      return {};
    }
    local.rotation = rotation / length;
  }
  if (!node.translation.empty()) local.translation = {node.translation[0], node.translation[1], node.translation[2]};
  if (!node.scale.empty()) local.scale = {node.scale[0], node.scale[1], node.scale[2]};
  return local;
}

} // namespace gnomon
