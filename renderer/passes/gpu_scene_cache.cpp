#include "renderer/passes/gpu_scene_cache.h"

#include <algorithm>

namespace gnomon {

const GpuScene& GpuSceneCache::get(const std::shared_ptr<const Scene>& scene) {
  return entryOf(scene).gpu;
}

const std::vector<EdgeMesh>& GpuSceneCache::edges(const std::shared_ptr<const Scene>& scene) {
  Entry& entry = entryOf(scene);
  if (!entry.edges) {
    entry.edges = edgeMeshes(*scene);
    drop();
  }
  return *entry.edges;
}

GpuSceneCache::Entry& GpuSceneCache::entryOf(const std::shared_ptr<const Scene>& scene) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.scene.lock() == scene; });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front();
  }
  auto textures = texturesOf(*scene);
  entries_.remove_if([](const Entry& entry) { return entry.scene.expired(); });
  entries_.push_front({scene, uploadScene(*scene, std::move(textures)), {}});
  entries_.front().gpu.id = ++uploads_;
  drop();
  return entries_.front();
}

/// Scenes that share their images are poses of one.
std::shared_ptr<const GpuTextures> GpuSceneCache::texturesOf(const Scene& scene) const {
  for (const Entry& entry : entries_) {
    const auto other = entry.scene.lock();
    if (other && !scene.images.empty() && other->images == scene.images) return entry.gpu.textures;
  }
  return uploadTextures(scene);
}

void GpuSceneCache::drop() {
  std::size_t bytes = 0;
  auto entry = entries_.begin();
  while (entry != entries_.end()) {
    bytes += entry->bytes();
    const bool keep = entry == entries_.begin() || bytes <= budgetBytes_;
    entry = keep ? std::next(entry) : entries_.erase(entry);
  }
}

} // namespace gnomon
