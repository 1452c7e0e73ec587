#pragma once

#include "renderer/core/stop.h"
#include "renderer/device/device.h"
#include "renderer/frame/environment_cache.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/light_map_cache.h"
#include "renderer/frame/traced_scene_cache.h"
#include "renderer/frame/volume_cache.h"

namespace gnomon {

/// What frames leave behind for later ones, whichever device draws them.
struct FrameCaches {
  TracedSceneCache traced;
  LightMapCache lightMaps;
  VolumeCache volumes;
  EnvironmentCache environments{};
};

/// A frame from top to bottom, on any device: settled, surveyed, planned, cast, shown, compared with rays where a
/// view asks, and reported. As Renderer::render.
Result<Frame> renderFrame(Device& device, FrameCaches& caches, const ScenePtr& scene, const FrameSpec& spec,
                          TileUse tiles = TileUse::kept, const GoOn& goOn = {});

} // namespace gnomon
