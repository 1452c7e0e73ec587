#pragma once

#include <functional>
#include <memory>

#include "renderer/environment/environment.h"
#include "renderer/frame/light_map_cache.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/frame/traced_scene_cache.h"

namespace gnomon {

struct FrameCaches;

/// Called with the light that is baked and its progress, 0..1, by one thread at a time; false asks to stop.
using BakeProgress = std::function<bool(int light, double share)>;

/// What is baked for each light of a frame, made now if need be; null for lights of other techniques. Empty where no
/// light asks for it. `asked`: the spec before it was settled, in which a map that would be too large is a problem.
/// Where `progress` asks to stop, a problem of code unavailable.
Result<std::vector<LightMapCache::Found>> bakedLights(LightMapCache& maps, TracedSceneCache& traced,
                                                      const SettledFrame& settled, const FrameSpec& asked,
                                                      const BakeProgress& progress = {});

/// A scene with light maps for some of its lights, or for its environment.
struct BakedScene {
  std::shared_ptr<const Scene> scene; ///< posed
  ResolvedFrame frame;
  std::vector<int> lights;                 ///< those that were baked: indices into the effective lights, ascending
  std::vector<LightMapCache::Found> found; ///< one an effective light, null where it was not baked; empty = none was
  LightMapCache::Found environment{};      ///< null where it was not baked
  FrameEnvironment around{};               ///< where it was
  double milliseconds = 0;                 ///< of all of it
};

/// As Baker::bake (render.h). Any thread.
Result<BakedScene> bakeScene(FrameCaches& caches, const std::shared_ptr<const Scene>& scene, const FrameSpec& spec,
                             const BakeListener& listener);

/// What was made; its key is left empty.
BakeReport reportOf(const BakedScene& baked);

} // namespace gnomon
