#include "renderer/passes/gpu_scene_cache.h"

#include <algorithm>

#include "renderer/scene/shared_content.h"

namespace gnomon {

const GpuScene& GpuSceneCache::get(const std::shared_ptr<const Scene>& scene) {
  return entryOf(scene).gpu;
}

const std::vector<EdgeMesh>& GpuSceneCache::edges(const std::shared_ptr<const Scene>& scene) {
  Entry& entry = entryOf(scene);
  if (!entry.edges) {
    const auto same = std::ranges::find_if(
        entries_, [&](const Entry& other) { return other.edges != nullptr && other.gpu.meshes == entry.gpu.meshes; });
    entry.edges =
        same != entries_.end() ? same->edges : std::make_shared<const std::vector<EdgeMesh>>(edgeMeshes(*scene));
    drop();
  }
  return *entry.edges;
}

GpuSceneCache::Entry& GpuSceneCache::entryOf(const std::shared_ptr<const Scene>& scene) {
  if (Entry* const known = entries_.findIf([&](const Entry& entry) { return entry.scene.lock() == scene; })) {
    return *known;
  }
  const auto matching = [&](bool (*same)(const Scene&, const Scene&)) {
    return [&scene, same](const Entry& entry) {
      const auto other = entry.scene.lock();
      return other && same(*other, *scene);
    };
  };
  if (Entry* const like = entries_.findIf(matching(sameSurfaces))) {
    like->scene = scene;
    return *like;
  }
  const auto ofMeshes = std::ranges::find_if(entries_, matching(sameMeshes));
  const auto ofTextures = std::ranges::find_if(entries_, matching(sameTextures));
  auto meshes = ofMeshes != entries_.end() ? ofMeshes->gpu.meshes : uploadMeshes(*scene);
  auto textures = ofTextures != entries_.end() ? ofTextures->gpu.textures : uploadTextures(*scene);
  entries_.eraseIf([](const Entry& entry) { return entry.scene.expired(); });
  Entry& added = entries_.add({scene, uploadScene(*scene, std::move(meshes), std::move(textures)), {}});
  added.gpu.id = ++uploads_;
  drop();
  return added;
}

void GpuSceneCache::drop() {
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return entry.bytes(); });
}

} // namespace gnomon
