#pragma once

#include <functional>

#include "renderer/frame/light_map_cache.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/frame/traced_scene_cache.h"

namespace gnomon {

/// Told which light is baked and how far it has come, 0..1, by one thread at a time; false asks to stop.
using BakeProgress = std::function<bool(int light, double share)>;

/// What is baked for each light of a frame, made now if need be; null for lights of other techniques. Empty where no
/// light asks for it. `asked`: the spec before it was settled, in which a map that would be too large is a problem.
/// Where `progress` asks to stop, a problem of code unavailable.
Result<std::vector<LightMapCache::Found>> bakedLights(LightMapCache& maps, TracedSceneCache& traced,
                                                      const SettledFrame& settled, const FrameSpec& asked,
                                                      const BakeProgress& progress = {});

} // namespace gnomon
