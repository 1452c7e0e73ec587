#pragma once

#include <memory>

#include "protocol/base/result.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The scene as an animation has it at a time: its nodes, and all that hangs on them. A problem where that takes
/// something beyond what is finite. REQUIRES: the scene has motion.
Result<std::shared_ptr<const Scene>> poseScene(const Scene& scene, const Animation& animation, double timeSeconds);

} // namespace gnomon
