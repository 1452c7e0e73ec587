#pragma once

#include "renderer/device/device.h"
#include "renderer/evaluation/evaluate.h"
#include "renderer/frame/traced_scene_cache.h"

namespace gnomon {

/// As Renderer::shimmer.
Result<Shimmer> measureShimmer(Device& device, TracedSceneCache& traced, const ScenePtr& scene, const FrameSpec& spec,
                               std::span<const Camera> path, const Progress& progress);

} // namespace gnomon
