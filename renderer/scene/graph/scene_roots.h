#pragma once

#include "protocol/spec/limits.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"

namespace gnomon {

/// Scenes may list only nodes without a parent. Where one lists a child of another node, each node is drawn once: below
/// its parent where a scene has that one, too, and else as a root, which the parent no longer moves. Repairs tell of
/// it.
void settleSceneRoots(gltf::Model& model, const Limits& limits, Findings& findings);

/// Tells of skins whose joints stand in several trees, or in none that a scene has although their mesh is in one. They
/// are moved by where the joints stand all the same. `order`: the nodes, parents before children.
void checkSkinRoots(const gltf::Model& model, const std::vector<int>& parents, const std::vector<int>& order,
                    Findings& findings);

} // namespace gnomon
