#pragma once

#include <functional>

#include "renderer/frame/light_map_cache.h"
#include "renderer/frame/traced_scene_cache.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// A scene as a frame shows it.
struct FrameScene {
  const std::shared_ptr<const Scene>& loaded;
  const std::shared_ptr<const Scene>& posed;
};

/// Told which light is baked and how far it has come, 0..1, by one thread at a time; false asks to stop.
using BakeProgress = std::function<bool(int light, double share)>;

/// What is baked for each light of a frame, made now if need be; null for lights of other techniques. Empty where no
/// light asks for it. `asked`: the spec before it was settled, whose fields problems point at: a map that would be too
/// large, and a node that the pose moves. Where `progress` asks to stop, a problem of code unavailable.
Result<std::vector<LightMapCache::Found>> bakedLights(LightMapCache& maps, TracedSceneCache& traced,
                                                      const FrameScene& scene, const FrameSpec& asked,
                                                      const ResolvedFrame& frame, const BakeProgress& progress = {});

} // namespace gnomon
