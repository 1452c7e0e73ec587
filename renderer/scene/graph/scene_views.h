#pragma once

#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/mesh_build.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/posing/posed_nodes.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The file's scenes, flattened.
struct FlatScenes {
  std::vector<SceneView> views;   ///< in the rest pose
  std::vector<MovingView> moving; ///< parallel to the views; empty where nothing moves
};

/// Flattens every scene of the file, nodes in ascending order; a file without scenes gets one of all its roots.
/// `moves`: whether the file has animations.
FlatScenes flattenScenes(const GltfDocument& document, const std::vector<AccessorView>& accessors, const NodeTree& tree,
                         const std::vector<BuiltMesh>& meshes, const std::vector<PosedMesh>& posed,
                         const std::vector<Primitive>& primitives, bool moves, const Limits& limits,
                         Findings& findings);

} // namespace gnomon
