#include "renderer/scene/summary.h"

#include <map>
#include <set>
#include <tuple>

#include "protocol/spec/enum_rows.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/animation/posed_scene.h"
#include "renderer/scene/checks/gltf_schema.h"
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

/// All that a pose of a scene is made from.
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

std::uint64_t bundleBytes(const SceneBundle& bundle) {
  std::uint64_t bytes = bundle.model.size();
  for (const auto& [name, file] : bundle.files) bytes += file.size();
  return bytes;
}

/// Nodes reachable from the scene's roots; the nodes are trees by now.
std::uint64_t nodesOf(const gltf::Model& model, int scene) {
  if (model.scenes.empty()) return model.nodes.size();
  std::vector<int> nodes = model.scenes[static_cast<std::size_t>(scene)].nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& children = model.nodes[static_cast<std::size_t>(nodes[i])].children;
    nodes.insert(nodes.end(), children.begin(), children.end());
  }
  return nodes.size();
}

/// Of what deforms in the scene: skins, their joints, and each mesh's morph targets, which all its primitives share.
void countDeformation(const gltf::Model& model, const Deformation& deformation, const std::set<int>& primitives,
                      SceneSummary& summary) {
  std::set<int> skins;
  std::map<int, std::uint64_t> targetsOfMesh;
  for (const PosedPrimitive& posed : deformation.posed) {
    if (!primitives.contains(posed.primitive)) continue;
    if (posed.skin >= 0) skins.insert(posed.skin);
    targetsOfMesh[model.nodes[static_cast<std::size_t>(posed.node)].mesh] =
        deformation.deformables[static_cast<std::size_t>(posed.deformable)].targets.size();
  }
  summary.skins = skins.size();
  for (const int skin : skins) summary.joints += deformation.skins[static_cast<std::size_t>(skin)].joints.size();
  for (const auto& [mesh, targets] : targetsOfMesh) summary.morphTargets += targets;
}

/// Counts what the scene places, each once.
void countContents(const gltf::Model& model, const Scene& scene, const SceneView& view, SceneSummary& summary) {
  std::set<int> primitives;
  std::set<int> meshes;
  for (const Instance& instance : view.instances) {
    primitives.insert(instance.primitive);
    meshes.insert(model.nodes[static_cast<std::size_t>(instance.node)].mesh);
  }
  std::set<int> materials;
  std::set<int> images;
  std::set<std::tuple<int, Wrap, Wrap, bool>> textures;
  for (const int index : primitives) {
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(index)];
    summary.vertices += primitive.vertexCount;
    materials.insert(primitive.material);
  }
  for (const int index : materials) {
    const Material& material = scene.materials[static_cast<std::size_t>(index)];
    for (const auto* texture : texturesOf(material)) {
      if (!*texture) continue;
      const TextureUse& use = **texture;
      images.insert(use.image);
      textures.insert({use.image, use.wrapS, use.wrapT, use.nearest});
    }
  }
  summary.instances = view.instances.size();
  summary.meshes = meshes.size();
  summary.materials = materials.size();
  summary.textures = textures.size();
  summary.images = images.size();
  if (scene.deformation) countDeformation(model, *scene.deformation, primitives, summary);
}

} // namespace

MemorySummary memoryOf(const Scene& scene) {
  MemorySummary memory;
  memory.vertices = bytesIn(scene.positions) + bytesIn(scene.attributes);
  memory.indices = bytesIn(scene.indices) + bytesIn(scene.welded);
  for (const auto& image : scene.images) memory.images += image->bytes();
  for (const auto& [name, file] : scene.grids) memory.volumes += file->size();
  for (const auto& [name, file] : scene.environmentFiles) memory.environments += file->memory();
  for (const auto& light : scene.imageBasedLights) memory.environments += light ? light->memory() : 0;
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
  return memory.vertices + memory.indices + memory.images + memory.volumes + memory.environments + memory.deformation +
         memory.animations + memory.structure;
}

SceneSummary summarize(const gltf::Model& model, const SceneBundle& bundle, const Scene& scene) {
  const SceneView& view = scene.scenes[static_cast<std::size_t>(scene.defaultScene)];
  SceneSummary summary;
  summary.bytes = bundleBytes(bundle);
  summary.memory = memoryOf(scene);
  summary.memoryBytes = bytesIn(summary.memory);
  summary.scenes = fileScenes(scene);
  summary.defaultScene = scene.defaultScene;
  summary.nodes = nodesOf(model, scene.defaultScene);
  summary.triangles = view.triangles;
  countContents(model, scene, view, summary);
  for (const Animation& animation : scene.motion->animations) {
    summary.animations.push_back({animation.name, animation.durationSeconds});
  }
  if (!view.bounds.empty()) {
    summary.boundsMin = {view.bounds.min.x, view.bounds.min.y, view.bounds.min.z};
    summary.boundsMax = {view.bounds.max.x, view.bounds.max.y, view.bounds.max.z};
  }
  for (const SceneCamera& camera : view.cameras) {
    summary.cameras.push_back({camera.node, camera.name, camera.perspective ? "perspective" : "orthographic"});
  }
  for (const SceneLight& light : view.lights) {
    summary.lights.push_back({light.node, light.name, std::string(spell(light.light.type))});
  }
  if (view.imageBasedLight >= 0) summary.environmentLight = view.imageBasedLight;
  summary.materialVariants = scene.variants;
  for (const auto& [name, file] : scene.grids) summary.volumeFiles.push_back(name);
  for (const auto& [name, file] : scene.environmentFiles) summary.environmentFiles.push_back(name);
  summary.extensionsUsed = model.extensionsUsed;
  summary.extensionsIgnored = unsupportedOf(model.extensionsUsed);
  return summary;
}

} // namespace gnomon
