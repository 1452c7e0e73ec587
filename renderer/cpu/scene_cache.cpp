#include "renderer/cpu/scene_cache.h"

#include <algorithm>

namespace gnomon::cpu {

CachedScene& SceneCache::of(const std::shared_ptr<const Scene>& scene) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.scene.lock() == scene; });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front().cached;
  }
  entries_.remove_if([](const Entry& entry) { return entry.scene.expired(); });
  entries_.push_front({scene, {++scenes_}});
  return entries_.front().cached;
}

} // namespace gnomon::cpu
