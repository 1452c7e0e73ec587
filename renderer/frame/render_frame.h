#pragma once

#include "renderer/device/device.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/traced_scene_cache.h"

namespace gnomon {

/// A frame from top to bottom, whoever draws it: settled, surveyed, planned, cast, shown, compared with rays where a
/// view asks, and reported. As Renderer::render.
Result<Frame> renderFrame(Device& device, TracedSceneCache& traced, const ScenePtr& scene, const FrameSpec& spec,
                          TileUse tiles = TileUse::kept);

} // namespace gnomon
