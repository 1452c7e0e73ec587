#include "renderer/passes/gpu_scene_cache.h"

#include <algorithm>

#include "renderer/scene/alike.h"

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
  const auto alike = [&](bool (*same)(const Scene&, const Scene&)) {
    return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
      const auto other = entry.scene.lock();
      return other && same(*other, *scene);
    });
  };
  if (const auto like = alike(sameSurfaces); like != entries_.end()) {
    like->scene = scene;
    entries_.splice(entries_.begin(), entries_, like);
    return entries_.front();
  }
  const auto ofMeshes = alike(sameMeshes);
  const auto ofTextures = alike(sameTextures);
  auto meshes = ofMeshes != entries_.end() ? ofMeshes->gpu.meshes : uploadMeshes(*scene);
  auto textures = ofTextures != entries_.end() ? ofTextures->gpu.textures : uploadTextures(*scene);
  entries_.remove_if([](const Entry& entry) { return entry.scene.expired(); });
  entries_.push_front({scene, uploadScene(*scene, std::move(meshes), std::move(textures)), {}});
  entries_.front().gpu.id = ++uploads_;
  drop();
  return entries_.front();
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
