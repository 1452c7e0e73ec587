#pragma once

#include <memory>

#include "renderer/frame/bake_listener.h"
#include "renderer/frame/baked_lights.h"

namespace gnomon {

struct FrameCaches;

/// A scene with light maps for some of its lights.
struct BakedScene {
  std::shared_ptr<const Scene> scene; ///< posed
  ResolvedFrame frame;
  std::vector<int> lights;                 ///< those that were baked: indices into the effective lights, ascending
  std::vector<LightMapCache::Found> found; ///< one an effective light, null where it was not baked
  double milliseconds = 0;                 ///< of all of it
};

/// Bakes every light of `spec` whose technique is lightMap, or finds what was baked earlier; a frame of that spec then
/// reuses it. Camera, size and views do not matter. Problems: those of a frame, one at /shadow/technique where no light
/// is baked, and one of code unavailable where `listener` asked to stop. Any thread.
Result<BakedScene> bakeScene(FrameCaches& caches, const std::shared_ptr<const Scene>& scene, const FrameSpec& spec,
                             const BakeListener& listener);

/// What was made; its key is left empty.
BakeReport reportOf(const BakedScene& baked);

} // namespace gnomon
