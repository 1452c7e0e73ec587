#include "renderer/scene/materials/materials.h"

#include <array>
#include <cmath>
#include <utility>

#include "renderer/scene/animation/motion.h"

namespace gnomon {

namespace {

void readAlpha(const gltf::Material& source, const std::string& name, Material& material, Findings& findings) {
  if (source.alphaMode == gltf::AlphaMode::mask) {
    material.cutoff = static_cast<float>(source.alphaCutoff);
  } else if (source.alphaMode == gltf::AlphaMode::blend) {
    material.cutoff = 0.5f;
    material.lightOpacity = 1;
    findings.warn("The " + name + " uses alpha blending; it is drawn opaque where its alpha is at least 0.5.");
  }
}

void readTransmission(const gltf::Material& source, const std::string& name, Material& material, Findings& findings) {
  const gltf::Transmission& extension = *source.transmission;
  material.transmission = static_cast<float>(extension.factor);
  if (!(material.transmission > 0)) return;
  findings.warn("The " + name +
                " is transmissive; the surroundings are visible through it, but objects behind it are not.");
  if (extension.texture) {
    findings.warn("The transmission texture of the " + name + " is ignored.");
  }
  if (source.alphaMode != gltf::AlphaMode::mask) material.lightOpacity = 1 - material.transmission;
}

/// All but the textures. `name` says in warnings which material it is.
Material readFactors(const gltf::Material& source, const std::string& name, Findings& findings) {
  Material material;
  material.name = source.name;
  material.baseColorFactor = glm::vec4(source.baseColorFactor);
  material.metallicFactor = static_cast<float>(source.metallicFactor);
  material.roughnessFactor = static_cast<float>(source.roughnessFactor);
  material.normalScale = static_cast<float>(source.normalScale);
  material.occlusionStrength = static_cast<float>(source.occlusionStrength);
  material.emissiveFactor =
      glm::vec3(source.emissiveFactor) * static_cast<float>(source.emissiveStrength.value_or(1.0));
  material.doubleSided = source.doubleSided;
  readAlpha(source, name, material, findings);
  if (const auto& glossy = source.specularGlossiness) {
    material.baseColorFactor = glm::vec4(glossy->diffuseFactor);
    material.specularGlossiness =
        SpecularGlossiness{glm::vec3(glossy->specularFactor), static_cast<float>(glossy->glossinessFactor)};
  }
  material.unlit = source.unlit;
  if (source.transmission) readTransmission(source, name, material, findings);
  return material;
}

/// What a material says of the textures of texturesOf(), in that order.
std::array<const std::optional<gltf::TextureInfo>*, 5> textureInfosOf(const gltf::Material& source) {
  const auto& glossy = source.specularGlossiness;
  return {glossy ? &glossy->diffuseTexture : &source.baseColorTexture,
          glossy ? &glossy->specularGlossinessTexture : &source.metallicRoughnessTexture, &source.normalTexture,
          &source.occlusionTexture, &source.emissiveTexture};
}

/// The image of a texture: its WebP, else that in a format of glTF's own; -1 = none.
int imageOf(const gltf::Texture& texture, std::size_t index, Findings& findings) {
  if (texture.webp >= 0) return texture.webp;
  if (texture.source < 0 && texture.basisu) {
    findings.warn("The texture at " + pointerTo("/textures", index) +
                  " has only a KTX 2 image (KHR_texture_basisu), which is not supported, and no fallback image; it is "
                  "left out.");
  }
  return texture.source;
}

/// The texture that a textureInfo names; nothing, and a warning, where it can't be drawn.
std::optional<TextureUse> readTexture(const gltf::Model& model, const gltf::TextureInfo& info, const std::string& name,
                                      Findings& findings) {
  const auto index = static_cast<std::size_t>(info.texture);
  const gltf::Texture& texture = model.textures[index];
  TextureUse use;
  use.image = imageOf(texture, index, findings);
  if (use.image < 0) {
    findings.warn("The texture " + std::to_string(index) + " of the " + name +
                  " has no image in a supported format; it is left out.");
    return std::nullopt;
  }
  use.texCoord = info.texCoord;
  use.transform = transformOf(info);
  if (texture.sampler >= 0) {
    const gltf::TextureSampler& sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
    use.wrapS = sampler.wrapS;
    use.wrapT = sampler.wrapT;
    use.minFilter = sampler.minFilter;
    use.nearest = sampler.nearest;
  }
  return use;
}

constexpr const char* kPointer = "/extensions/KHR_materials_variants/variants";

} // namespace

std::string nameOfMaterial(std::size_t index, const std::string& name) {
  return "material " + std::to_string(index) + (name.empty() ? "" : " " + inQuotes(name));
}

/// The extension's matrix: translation * rotation * scale, with v downwards.
std::optional<TextureTransform> transformOf(const gltf::TextureInfo& info) {
  if (!info.transform) return std::nullopt;
  const glm::vec2 scale(info.transform->scale);
  const auto c = static_cast<float>(std::cos(info.transform->rotation));
  const auto s = static_cast<float>(std::sin(info.transform->rotation));
  const TextureTransform transform{glm::mat2(glm::vec2(c, -s) * scale.x, glm::vec2(s, c) * scale.y),
                                   glm::vec2(info.transform->offset)};
  if (transform.axes == glm::mat2(1) && transform.offset == glm::vec2(0)) return std::nullopt;
  return transform;
}

std::vector<Material> readMaterials(const gltf::Model& model, Findings& findings) {
  std::vector<Material> materials;
  materials.reserve(model.materials.size() + 1);
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const gltf::Material& source = model.materials[i];
    const std::string name = nameOfMaterial(i, source.name);
    Material& material = materials.emplace_back(readFactors(source, name, findings));
    const auto textures = texturesOf(material);
    const auto infos = textureInfosOf(source);
    for (std::size_t t = 0; t < infos.size(); ++t) {
      if (*infos[t]) *textures[t] = readTexture(model, **infos[t], name, findings);
    }
  }
  materials.emplace_back();
  return materials;
}

Material repainted(const Material& loaded, const gltf::Material& source) {
  Findings said; // when the file was loaded
  Material material = readFactors(source, {}, said);
  material.hasVertexColors = loaded.hasVertexColors;
  const auto from = texturesOf(loaded);
  const auto to = texturesOf(material);
  const auto infos = textureInfosOf(source);
  for (std::size_t i = 0; i < infos.size(); ++i) {
    *to[i] = *from[i];
    if (*to[i]) (*to[i])->transform = transformOf(**infos[i]);
  }
  return material;
}

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
