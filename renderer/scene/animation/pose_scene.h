#pragma once

#include <memory>
#include <span>

#include "protocol/base/result.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/animation/node_places.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// How a scene is posed: an animation at a time, and after that places of nodes.
struct PoseInput {
  const Animation* animation = nullptr; ///< nullptr = the rest pose
  double timeSeconds = 0;
  std::span<const NodePlace> places{}; ///< ascending by node
};

/// The scene in a pose: its nodes, and all that hangs on them. It shares images, and the vertices where none is
/// deformed. A problem where that takes something beyond what is finite: at /nodes where a place moves it, else at
/// /animation. REQUIRES: the scene has motion.
Result<std::shared_ptr<const Scene>> poseScene(const Scene& scene, const PoseInput& input);

} // namespace gnomon
