#include "renderer/passes/gpu_scene_cache.h"

#include <algorithm>

namespace gnomon {

const GpuScene& GpuSceneCache::get(const std::shared_ptr<const Scene>& scene) {
  return entryOf(scene).gpu;
}

const std::vector<EdgeMesh>& GpuSceneCache::edges(const std::shared_ptr<const Scene>& scene) {
  Entry& entry = entryOf(scene);
  if (!entry.edges) {
    const auto same = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& other) {
      return other.edges != nullptr && other.gpu.meshes == entry.gpu.meshes;
    });
    entry.edges =
        same != entries_.end() ? same->edges : std::make_shared<const std::vector<EdgeMesh>>(edgeMeshes(*scene));
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
  const Entry* same = sameMeshes(*scene);
  auto meshes = same != nullptr ? same->gpu.meshes : uploadMeshes(*scene);
  entries_.remove_if([](const Entry& entry) { return entry.scene.expired(); });
  entries_.push_front({scene, uploadScene(*scene, std::move(meshes), std::move(textures)), {}});
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

/// Poses that move nothing but nodes share their vertices; null where none of the scene has been uploaded.
const GpuSceneCache::Entry* GpuSceneCache::sameMeshes(const Scene& scene) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    const auto other = entry.scene.lock();
    return other && other->positions.sharesWith(scene.positions) && other->attributes.sharesWith(scene.attributes) &&
           other->indices.sharesWith(scene.indices) && other->welded.sharesWith(scene.welded);
  });
  return found == entries_.end() ? nullptr : &*found;
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
