#include "renderer/scene/materials/variants.h"

#include <utility>

#include "renderer/scene/animation/motion.h"

namespace gnomon {

namespace {

constexpr const char* kPointer = "/extensions/KHR_materials_variants/variants";

} // namespace

void checkVariantCount(const gltf::Model& model, const Limits& limits, Findings& findings) {
  const std::size_t variants = model.variants.size();
  std::size_t primitives = 0;
  for (const gltf::Mesh& mesh : model.meshes) primitives += mesh.primitives.size();
  if (variants == 0 || primitives <= limits.maxInstances / variants) return;
  findings.tooLarge(kPointer, "The file has too many material variants for its primitives.",
                    std::to_string(limits.maxInstances),
                    std::to_string(variants) + " of " + std::to_string(primitives) + " primitives");
}

std::vector<int> variantMaterials(const gltf::Model& model, const gltf::Primitive& primitive) {
  if (primitive.variantMappings.empty()) return {};
  std::vector<int> materials(model.variants.size(), -1);
  for (const gltf::VariantMapping& mapping : primitive.variantMappings) {
    for (const std::size_t variant : mapping.variants) materials[variant] = mapping.material;
  }
  return materials;
}

std::vector<SceneView> variantViews(const Scene& scene, const std::vector<SceneView>& views) {
  std::vector<SceneView> made;
  made.reserve(views.size() * scene.variants.size());
  for (std::size_t variant = 0; variant < scene.variants.size(); ++variant) {
    for (SceneView view : views) {
      for (Instance& instance : view.instances) {
        const auto& materials = scene.primitives[static_cast<std::size_t>(instance.primitive)].variantMaterials;
        if (!materials.empty()) instance.material = materials[variant];
      }
      made.push_back(std::move(view));
    }
  }
  return made;
}

void addVariantScenes(const Limits& limits, Scene& scene, Findings& findings) {
  std::size_t placed = 0;
  for (std::size_t i = 0; i < scene.scenes.size(); ++i) {
    const SceneView& view = scene.scenes[i];
    const auto count = [](std::size_t instances, const auto& of) {
      return instances + of.cameras.size() + of.lights.size() + 1;
    };
    // A pose may place more than the rest pose does.
    placed += scene.motion ? count(scene.motion->views[i].placements.size(), scene.motion->views[i])
                           : count(view.instances.size(), view);
  }
  if (placed > limits.maxInstances / (scene.variants.size() + 1)) {
    findings.tooLarge(kPointer, "The scenes place too many nodes and primitives in all material variants.",
                      std::to_string(limits.maxInstances),
                      std::to_string(scene.variants.size() + 1) + " times " + std::to_string(placed));
    return;
  }
  std::vector<SceneView> views = variantViews(scene, scene.scenes);
  for (SceneView& view : views) scene.scenes.push_back(std::move(view));
}

} // namespace gnomon
