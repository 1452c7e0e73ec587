#include "renderer/cpu/scene_cache.h"

#include "renderer/scene/shared_content.h"

namespace gnomon::cpu {

CachedScene& SceneCache::of(const std::shared_ptr<const Scene>& scene) {
  if (Entry* const same = entries_.findIf([&](const Entry& entry) { return entry.scene.lock() == scene; })) {
    return same->cached;
  }
  if (Entry* const like = entries_.findIf([&](const Entry& entry) {
        const auto other = entry.scene.lock();
        return other && sameSurfaces(*other, *scene);
      })) {
    like->scene = scene;
    return like->cached;
  }
  CachedScene cached = made(*scene);
  entries_.eraseIf([](const Entry& entry) { return entry.scene.expired(); });
  return entries_.add({scene, std::move(cached)}).cached;
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
