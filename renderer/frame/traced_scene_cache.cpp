#include "renderer/frame/traced_scene_cache.h"

#include <algorithm>

#include "renderer/core/stop.h"
#include "renderer/scene/shared_content.h"
#include "renderer/scene/summary.h"

namespace gnomon {

namespace {

/// Each has an Embree device, which takes one of the 1,024 keys that a process has for what threads store.
constexpr std::size_t kMostScenes = 256;

} // namespace

Result<std::shared_ptr<const TracedScene>> TracedSceneCache::get(const std::shared_ptr<const Scene>& scene, int index) {
  const auto lock = lockUnlessStopped(mutex_);
  Entry* const found = entries_.findIf(
      [&](const Entry& entry) { return entry.index == index && sameSurfaces(entry.traced->scene(), *scene); });
  if (found) {
    found->scene = scene;
    return found->traced;
  }
  auto made = TracedScene::build(scene, index);
  if (!made) return made.problems();
  auto traced = std::make_shared<const TracedScene>(std::move(*made));
  entries_.add({scene, index, traced});
  drop();
  return traced;
}

/// Of a scene that only the traced one keeps alive: the caller has a later one with the same surfaces, and the images
/// are its own, too.
std::uint64_t TracedSceneCache::olderSceneBytes(const Entry& entry) {
  if (entry.scene.lock().get() == &entry.traced->scene()) return 0;
  MemorySummary memory = memoryOf(entry.traced->scene());
  memory.images = 0;
  return bytesIn(memory);
}

/// A traced scene keeps its scene alive, so that one with no other holder is out of use.
std::vector<const TracedScene*> TracedSceneCache::outOfUse() const {
  std::vector<const TracedScene*> idle;
  for (const Entry& entry : entries_) {
    const auto scene = entry.scene.lock();
    const auto holders = 1 + std::count_if(entries_.begin(), entries_.end(),
                                           [&](const Entry& other) { return &other.traced->scene() == scene.get(); });
    if (scene.use_count() <= holders) idle.push_back(entry.traced.get());
  }
  return idle;
}

void TracedSceneCache::drop() {
  const std::vector<const TracedScene*> idle = outOfUse();
  entries_.eraseIf(
      [&idle](const Entry& entry) { return std::find(idle.begin(), idle.end(), entry.traced.get()) != idle.end(); });
  entries_.keepNewest(kMostScenes);
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return entry.traced->bytes() + olderSceneBytes(entry); });
}

} // namespace gnomon
