#pragma once

#include <memory>

#include "protocol/base/lru.h"
#include "renderer/cpu/surface/textures.h"
#include "renderer/scene/mask_coverage.h"

namespace gnomon::cpu {

/// What frames of one scene share beside it.
struct CachedScene {
  std::uint64_t id = 0; ///< no other scene's but of the same surfaces
  std::shared_ptr<Textures> textures;
  std::shared_ptr<KeptCoverages> coverages; ///< as long as these
};

/// Of the scenes drawn lately; those with the same surfaces are one. What belongs to a scene that is gone goes with the
/// next one that comes.
class SceneCache {
 public:
  /// Valid until the next call.
  CachedScene& of(const std::shared_ptr<const Scene>& scene);

 private:
  struct Entry {
    std::weak_ptr<const Scene> scene;
    CachedScene cached;
  };
  /// With the textures and coverages of a scene that has the same images, and a new id.
  CachedScene made(const Scene& scene);

  LruList<Entry> entries_;
  std::uint64_t scenes_ = 0;
};

} // namespace gnomon::cpu
