#include <cmath>
#include <map>
#include <set>

#include "renderer/export/baked_glb.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

using nlohmann::json;

constexpr int kPngLevel = 2;

json transformJson(const TextureTransform& transform) {
  const glm::vec2 first = transform.axes[0];
  const float width = glm::length(first);
  const float height = width > 0 ? glm::determinant(transform.axes) / width : glm::length(transform.axes[1]);
  return {{"offset", {transform.offset.x, transform.offset.y}},
          {"rotation", std::atan2(-first.y, first.x)},
          {"scale", {width, height}}};
}

/// Adds what materials refer to, each once.
class MaterialWriter {
 public:
  MaterialWriter(const Scene& scene, GlbDraft& draft) : scene_(scene), draft_(draft) {}

  Status addImages(const std::vector<std::uint8_t>& used) {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      if (used[i] == 0) continue;
      for (const auto* use : texturesOf(scene_.materials[i])) {
        if (!*use || images_.contains((*use)->image)) continue;
        const SceneImage& image = *scene_.images[static_cast<std::size_t>((*use)->image)];
        if (Status decoded = image.decode(); !decoded) return decoded;
        const auto png = encodePng(image.pixels(), kPngLevel);
        if (!png) return png.problems();
        images_[(*use)->image] = draft_.addPng(*png);
      }
    }
    return Done{};
  }

  json textureInfo(const TextureUse& use) {
    json info = {{"index", texture(use)}, {"texCoord", use.texCoord == 0 ? 0 : 2}};
    if (use.transform) {
      extensions_.insert("KHR_texture_transform");
      info["extensions"]["KHR_texture_transform"] = transformJson(*use.transform);
    }
    return info;
  }

  json material(const Material& source) {
    json result = {{"name", source.name},
                   {"doubleSided", source.doubleSided},
                   {"emissiveFactor", {source.emissiveFactor.x, source.emissiveFactor.y, source.emissiveFactor.z}}};
    glm::vec4 color = source.baseColorFactor;
    if (source.lightOpacity) {
      result["alphaMode"] = "BLEND";
      color.a = *source.lightOpacity * (hasHoles(source) ? color.a : 1.0f);
    } else if (source.cutoff) {
      result["alphaMode"] = "MASK";
      result["alphaCutoff"] = *source.cutoff;
    }
    json& surface = result["pbrMetallicRoughness"];
    surface = {{"baseColorFactor", {color.r, color.g, color.b, color.a}},
               {"metallicFactor", source.specularGlossiness ? 0 : source.metallicFactor},
               {"roughnessFactor",
                source.specularGlossiness ? 1 - source.specularGlossiness->glossinessFactor : source.roughnessFactor}};
    if (source.baseColor) surface["baseColorTexture"] = textureInfo(*source.baseColor);
    if (source.metallicRoughness && !source.specularGlossiness) {
      surface["metallicRoughnessTexture"] = textureInfo(*source.metallicRoughness);
    }
    if (source.normal) {
      result["normalTexture"] = textureInfo(*source.normal);
      result["normalTexture"]["scale"] = source.normalScale;
    }
    if (source.occlusion) {
      result["occlusionTexture"] = textureInfo(*source.occlusion);
      result["occlusionTexture"]["strength"] = source.occlusionStrength;
    }
    if (source.emissive) result["emissiveTexture"] = textureInfo(*source.emissive);
    if (source.unlit) {
      extensions_.insert("KHR_materials_unlit");
      result["extensions"]["KHR_materials_unlit"] = json::object();
    }
    return result;
  }

  void use(const std::string& extension) { extensions_.insert(extension); }
  const std::set<std::string>& extensions() const { return extensions_; }

 private:
  std::size_t texture(const TextureUse& use) {
    const json sampler = {{"wrapS", static_cast<int>(use.wrapS)},
                          {"wrapT", static_cast<int>(use.wrapT)},
                          {"magFilter", static_cast<int>(use.nearest ? MinFilter::nearest : MinFilter::linear)},
                          {"minFilter", static_cast<int>(use.minFilter)}};
    const auto number = [this](const char* list, const json& entry) {
      const auto [found, isNew] =
          known_[list].try_emplace(entry.dump(), draft_.json.contains(list) ? draft_.json[list].size() : 0);
      if (isNew) draft_.json[list].push_back(entry);
      return found->second;
    };
    return number("textures", {{"source", images_.at(use.image)}, {"sampler", number("samplers", sampler)}});
  }

  const Scene& scene_;
  GlbDraft& draft_;
  std::map<int, std::size_t> images_; ///< of the scene -> of the draft
  std::map<std::string, std::map<std::string, std::size_t>> known_;
  std::set<std::string> extensions_;
};

} // namespace

std::size_t GlbDraft::addView(std::span<const std::uint8_t> bytes) {
  binary.resize((binary.size() + 3) / 4 * 4);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  return json["bufferViews"].size() - 1;
}

std::size_t GlbDraft::addPng(std::span<const std::uint8_t> png) {
  json["images"].push_back({{"bufferView", addView(png)}, {"mimeType", "image/png"}});
  return json["images"].size() - 1;
}

bool readsUv(const Material& material, int set) {
  for (const auto* use : texturesOf(material)) {
    if (*use && (*use)->texCoord == set) return true;
  }
  return false;
}

Result<std::vector<int>> addMaterials(const Scene& scene, const std::vector<std::uint8_t>& used, std::size_t map,
                                      float intensity, GlbDraft& draft) {
  MaterialWriter writer(scene, draft);
  if (Status added = writer.addImages(used); !added) return added.problems();
  std::vector<int> numbers(scene.materials.size(), -1);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (used[i] == 0) continue;
    json material = writer.material(scene.materials[i]);
    if (!scene.materials[i].unlit) {
      writer.use("MOZ_lightmap");
      material["extensions"]["MOZ_lightmap"] = {{"index", map}, {"texCoord", 1}, {"intensity", intensity}};
    }
    numbers[i] = draft.json.contains("materials") ? static_cast<int>(draft.json["materials"].size()) : 0;
    draft.json["materials"].push_back(std::move(material));
  }
  if (!writer.extensions().empty()) draft.json["extensionsUsed"] = writer.extensions();
  return numbers;
}

} // namespace gnomon
