#pragma once

#include <nlohmann/json.hpp>

#include "renderer/scene/findings.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Checks what the schema can't: the lens that the type asks for, and far beyond near.
void checkCameras(const nlohmann::json& document, Findings& findings);

/// The camera that hangs on a node, not placed. REQUIRES: the node has one.
SceneCamera unplacedCamera(const GltfDocument& document, std::size_t node, Findings& findings);

/// Nothing where the matrix leaves it no direction.
std::optional<SceneCamera> placedAt(const glm::dmat4& worldFromUnscaled, SceneCamera camera);

/// The camera that hangs on a node; nothing, and a warning, where the node's matrix leaves it no direction.
std::optional<SceneCamera> cameraOf(const GltfDocument& document, const NodeTree& tree, std::size_t node,
                                    Findings& findings);

} // namespace gnomon
