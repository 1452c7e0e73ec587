#pragma once

#include <vector>

#include "protocol/limits.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/mesh_build.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/posing/posed_nodes.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Flattens every scene of the file, nodes in ascending order; a file without scenes gets one of all its roots.
std::vector<SceneView> flattenScenes(const GltfDocument& document, const std::vector<AccessorView>& accessors,
                                     const NodeTree& tree, const std::vector<BuiltMesh>& meshes,
                                     const std::vector<PosedMesh>& posed, const std::vector<Primitive>& primitives,
                                     const Limits& limits, Findings& findings);

} // namespace gnomon
