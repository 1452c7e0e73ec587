#pragma once

#include <vector>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/mesh_build.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/posing/pose.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The file's scenes, flattened.
struct FlatScenes {
  std::vector<SceneView> views;   ///< in the rest pose
  std::vector<MovingView> moving; ///< parallel to the views
};

/// What scenes are made of.
struct LoadedMeshes {
  const NodeTree& tree;
  const std::vector<BuiltMesh>& meshes;
  const std::vector<PosedMesh>& posed; ///< one a node
  const std::vector<Primitive>& primitives;
};

/// Flattens every scene of the file, nodes in ascending order; a file without scenes gets one of all roots. `animated`:
/// the file has animations.
FlatScenes flattenScenes(const LoadContext& load, const LoadedMeshes& loaded, bool animated);

} // namespace gnomon
