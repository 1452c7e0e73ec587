#include "renderer/cpu/scene_cache.h"

#include <algorithm>

#include "renderer/scene/alike.h"

namespace gnomon::cpu {

CachedScene& SceneCache::of(const std::shared_ptr<const Scene>& scene) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.scene.lock() == scene; });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front().cached;
  }
  if (const auto like = std::find_if(entries_.begin(), entries_.end(),
                                     [&](const Entry& entry) {
                                       const auto other = entry.scene.lock();
                                       return other && sameSurfaces(*other, *scene);
                                     });
      like != entries_.end()) {
    like->scene = scene;
    entries_.splice(entries_.begin(), entries_, like);
    return entries_.front().cached;
  }
  CachedScene cached = made(*scene);
  entries_.remove_if([](const Entry& entry) { return entry.scene.expired(); });
  entries_.push_front({scene, std::move(cached)});
  return entries_.front().cached;
}

/// Scenes that share their images are poses of one.
CachedScene SceneCache::made(const Scene& scene) {
  for (const Entry& entry : entries_) {
    const auto other = entry.scene.lock();
    if (other && !scene.images.empty() && other->images == scene.images) {
      return {++scenes_, entry.cached.textures, entry.cached.coverages};
    }
  }
  return {++scenes_, std::make_shared<Textures>(scene.images), std::make_shared<KeptCoverages>()};
}

} // namespace gnomon::cpu
