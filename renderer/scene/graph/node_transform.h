#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <tiny_gltf.h>

#include "renderer/scene/findings.h"
#include "renderer/scene/graph/local_transform.h"

namespace gnomon {

/// Refuses nodes that have a matrix beside a translation, rotation or scale.
void checkTransforms(const nlohmann::json& document, Findings& findings);

/// Refuses matrices that are not affine and rotations of length zero.
LocalTransform readTransform(const tinygltf::Node& node, const std::string& pointer, Findings& findings);

} // namespace gnomon
