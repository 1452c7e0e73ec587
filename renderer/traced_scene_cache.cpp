#include "renderer/traced_scene_cache.h"

#include <algorithm>

namespace gnomon {

Result<std::shared_ptr<const TracedScene>> TracedSceneCache::get(const std::shared_ptr<const Scene>& scene, int index) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.index == index && entry.scene.lock() == scene;
  });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front().traced;
  }
  auto traced = TracedScene::build(scene, index);
  if (!traced) return traced.problems();
  // A traced scene keeps its scene alive: one that nobody else holds is of no more use.
  entries_.remove_if([](const Entry& entry) { return entry.scene.use_count() <= 1; });
  entries_.push_front({scene, index, std::make_shared<const TracedScene>(std::move(*traced))});
  std::size_t bytes = 0;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    bytes += entry->traced->bytes();
    const bool keep = entry == entries_.begin() || bytes <= budgetBytes_;
    entry = keep ? std::next(entry) : entries_.erase(entry);
  }
  return entries_.front().traced;
}

} // namespace gnomon
