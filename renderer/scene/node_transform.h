#pragma once

#include <glm/glm.hpp>
#include <string>
#include <tiny_gltf.h>

#include "renderer/scene/findings.h"

namespace gnomon {

/// A node's own transform.
struct NodeTransform {
  glm::dmat4 parentFromNode{1};
  glm::dmat4 parentFromUnscaled{1}; ///< without its scale; a node with a `matrix` keeps it
};

/// Refuses matrices that are not affine, rotations of length zero, and a matrix beside translation, rotation or scale.
NodeTransform readTransform(const tinygltf::Node& node, const std::string& pointer, Findings& findings);

} // namespace gnomon
