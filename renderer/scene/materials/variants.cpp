#include "renderer/scene/materials/variants.h"

#include <utility>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/gltf_json.h"

namespace gnomon {

namespace {

constexpr const char* kExtension = "KHR_materials_variants";
constexpr const char* kPointer = "/extensions/KHR_materials_variants/variants";

} // namespace

void checkVariantCount(const GltfDocument& document, const Limits& limits, Findings& findings) {
  const std::size_t variants = variantNames(document).size();
  std::size_t primitives = 0;
  for (const tinygltf::Mesh& mesh : document.model.meshes) primitives += mesh.primitives.size();
  if (variants == 0 || primitives <= limits.maxInstances / variants) return;
  findings.tooLarge(kPointer, "The file has too many material variants for its primitives.",
                    std::to_string(limits.maxInstances),
                    std::to_string(variants) + " of " + std::to_string(primitives) + " primitives");
}

std::vector<std::string> variantNames(const GltfDocument& document) {
  std::vector<std::string> names;
  const nlohmann::json* extension = extensionOf(document.json, kExtension);
  if (extension == nullptr) return names;
  for (const auto& variant : extension->at("variants")) names.push_back(variant.at("name").get<std::string>());
  return names;
}

std::vector<int> variantMaterials(const GltfDocument& document, std::size_t mesh, std::size_t primitive) {
  const nlohmann::json* extension =
      extensionOf(document.json.at("meshes")[mesh].at("primitives")[primitive], kExtension);
  if (extension == nullptr || extensionOf(document.json, kExtension) == nullptr) return {};
  std::vector<int> materials(extensionOf(document.json, kExtension)->at("variants").size(), -1);
  for (const auto& mapping : extension->at("mappings")) {
    for (const auto& variant : mapping.at("variants")) {
      materials[variant.get<std::size_t>()] = mapping.at("material").get<int>();
    }
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
