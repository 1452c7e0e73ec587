#include "renderer/scene/memory.h"

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/animation/node_places.h"
#include "renderer/scene/animation/posed_scene.h"
#include "renderer/scene/posing/deformation.h"

namespace gnomon {

namespace {

template <class T>
std::uint64_t bytesIn(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}
template <class T>
std::uint64_t bytesIn(const SharedVector<T>& values) {
  return bytesIn(*values);
}

std::uint64_t bytesIn(const Deformation& deformation) {
  std::uint64_t bytes = bytesIn(deformation.posed);
  for (const Deformable& source : deformation.deformables) {
    bytes += bytesIn(source.mesh.positions) + bytesIn(source.mesh.attributes) + bytesIn(source.mesh.indices) +
             bytesIn(source.mesh.sources) + bytesIn(source.influences);
    for (const MorphTarget& target : source.targets) bytes += bytesIn(target);
  }
  for (const Skin& skin : deformation.skins) bytes += bytesIn(skin.joints) + bytesIn(skin.jointFromMesh);
  return bytes;
}

/// What it takes to pose a scene anew.
std::uint64_t bytesIn(const Motion& motion) {
  std::uint64_t bytes = bytesIn(motion.parents) + bytesIn(motion.order) + bytesIn(motion.locals);
  for (const Animation& animation : motion.animations) {
    bytes += bytesIn(animation.channels) + bytesIn(animation.properties);
    for (const Sampler& sampler : animation.samplers) bytes += bytesIn(sampler.times) + bytesIn(sampler.values);
  }
  for (const MovingView& view : motion.views) {
    bytes += bytesIn(view.placements) + bytesIn(view.cameras) + bytesIn(view.lights);
  }
  if (const auto& properties = motion.properties) {
    bytes += bytesIn(properties->materials) + bytesIn(properties->cameras) + bytesIn(properties->lights);
  }
  return bytes;
}

} // namespace

MemorySummary memoryOf(const Scene& scene) {
  MemorySummary memory;
  memory.vertices = bytesIn(scene.positions) + bytesIn(scene.attributes);
  memory.indices = bytesIn(scene.indices) + bytesIn(scene.welded);
  for (const auto& image : scene.images) memory.images += image->bytes();
  for (const auto& [name, file] : scene.grids) memory.volumes += file->size();
  if (scene.deformation) memory.deformation = bytesIn(*scene.deformation);
  memory.structure =
      bytesIn(scene.primitives) + bytesIn(scene.materials) + bytesIn(scene.nodes) + bytesIn(scene.placedNodes);
  for (const SceneNode& node : scene.nodes) memory.structure += node.name.size();
  for (const SceneView& view : scene.scenes) {
    memory.structure += bytesIn(view.roots) + bytesIn(view.instances) + bytesIn(view.cameras) + bytesIn(view.lights);
  }
  const std::uint64_t copies = scene.motion ? 1 + PoseCache::kKept : 1; // a pose has no poses of its own
  if (scene.deformation) {
    memory.vertices *= copies;
    memory.indices *= copies;
  }
  memory.indices += bytesIn(scene.clusters) * copies;
  memory.structure *= copies;
  if (!scene.motion) return memory;
  memory.structure += scene.nodes.size() * sizeof(NodePlace) * PoseCache::kKept;
  memory.animations = bytesIn(*scene.motion);
  return memory;
}

std::uint64_t bytesIn(const MemorySummary& memory) {
  return memory.vertices + memory.indices + memory.images + memory.volumes + memory.deformation + memory.animations +
         memory.structure;
}

} // namespace gnomon
