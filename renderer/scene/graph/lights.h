#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "renderer/scene/findings.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Checks what the schema can't: that a spot light has a cone, wider outside than inside.
void checkLights(const nlohmann::json& document, Findings& findings);

/// The KHR_lights_punctual light that hangs on a node, not placed; nothing where there is none.
std::optional<SceneLight> unplacedLight(const GltfDocument& document, std::size_t node, Findings& findings);

/// Nothing where it needs a direction and the matrix leaves it none.
std::optional<SceneLight> placedAt(const glm::dmat4& worldFromUnscaled, SceneLight light);

/// The KHR_lights_punctual light that hangs on a node, if there is one.
std::optional<SceneLight> lightOf(const GltfDocument& document, const NodeTree& tree, std::size_t node,
                                  Findings& findings);

} // namespace gnomon
