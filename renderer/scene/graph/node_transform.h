#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>

#include "renderer/scene/findings.h"

namespace gnomon {

/// A node's own transform.
struct NodeTransform {
  glm::dmat4 parentFromNode{1};
  glm::dmat4 parentFromUnscaled{1}; ///< without its scale; a node with a `matrix` keeps it
};

/// Refuses nodes that have a matrix beside a translation, rotation or scale.
void checkTransforms(const nlohmann::json& document, Findings& findings);

/// Refuses matrices that are not affine and rotations of length zero.
NodeTransform readTransform(const tinygltf::Node& node, const std::string& pointer, Findings& findings);

} // namespace gnomon
