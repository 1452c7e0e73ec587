#include "renderer/scene/materials/materials.h"

#include "renderer/scene/materials/material_extensions.h"

namespace gnomon {

namespace {

Wrap wrapOf(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clampToEdge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirroredRepeat;
    default:
      return Wrap::repeat;
  }
}

MinFilter minFilterOf(int filter) {
  switch (filter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      return MinFilter::nearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
      return MinFilter::linear;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      return MinFilter::nearestMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      return MinFilter::linearMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      return MinFilter::nearestMipmapLinear;
    default:
      return MinFilter::linearMipmapLinear;
  }
}

std::string nameOf(std::size_t index, const std::string& name) {
  return "material " + std::to_string(index) + (name.empty() ? "" : " " + inQuotes(name));
}

class MaterialReading {
 public:
  MaterialReading(const GltfDocument& document, std::size_t index, Findings& findings)
      : document_(document),
        source_(document.model.materials[index]),
        json_(document.json.at("materials")[index]),
        name_(nameOf(index, source_.name)),
        findings_(findings) {}

  Material read() const {
    Material material;
    const auto& pbr = source_.pbrMetallicRoughness;
    material.name = source_.name;
    for (int i = 0; i < 4; ++i) material.baseColorFactor[i] = static_cast<float>(pbr.baseColorFactor[std::size_t(i)]);
    material.metallicFactor = static_cast<float>(pbr.metallicFactor);
    material.roughnessFactor = static_cast<float>(pbr.roughnessFactor);
    material.normalScale = static_cast<float>(source_.normalTexture.scale);
    material.occlusionStrength = static_cast<float>(source_.occlusionTexture.strength);
    material.emissiveFactor = emissiveFactor();
    material.doubleSided = source_.doubleSided;
    readAlpha(material);
    material.normal = texture(json_, "normalTexture");
    material.occlusion = texture(json_, "occlusionTexture");
    material.emissive = texture(json_, "emissiveTexture");
    if (const auto* glossy = materialExtension(json_, "KHR_materials_pbrSpecularGlossiness")) {
      readSpecularGlossiness(*glossy, material);
      material.baseColor = texture(*glossy, "diffuseTexture");
      material.metallicRoughness = texture(*glossy, "specularGlossinessTexture");
    } else if (const auto found = json_.find("pbrMetallicRoughness"); found != json_.end()) {
      material.baseColor = texture(*found, "baseColorTexture");
      material.metallicRoughness = texture(*found, "metallicRoughnessTexture");
    }
    material.unlit = materialExtension(json_, "KHR_materials_unlit") != nullptr;
    if (const auto* transmission = materialExtension(json_, "KHR_materials_transmission")) {
      readTransmission(*transmission, name_, material, findings_);
    }
    return material;
  }

 private:
  glm::vec3 emissiveFactor() const {
    double strength = 1;
    const auto extension = source_.extensions.find("KHR_materials_emissive_strength");
    if (extension != source_.extensions.end() && extension->second.Has("emissiveStrength")) {
      strength = extension->second.Get("emissiveStrength").GetNumberAsDouble();
    }
    glm::dvec3 factor(0);
    if (source_.emissiveFactor.size() == 3) {
      factor = {source_.emissiveFactor[0], source_.emissiveFactor[1], source_.emissiveFactor[2]};
    }
    return glm::vec3(factor * strength);
  }

  void readAlpha(Material& material) const {
    if (source_.alphaMode == "MASK") {
      material.alphaMode = AlphaMode::mask;
      material.alphaCutoff = static_cast<float>(source_.alphaCutoff);
    } else if (source_.alphaMode == "BLEND") {
      material.alphaMode = AlphaMode::blend;
      material.alphaCutoff = 0.5f;
      findings_.warn("The " + name_ + " is blended; the camera sees it solid where its alpha is at least 0.5.");
    }
  }

  /// The texture that a member of `owner` names, if it does.
  std::optional<TextureUse> texture(const nlohmann::json& owner, const char* member) const {
    const auto info = owner.find(member);
    if (info == owner.end()) return std::nullopt;
    const int index = info->at("index").get<int>();
    const int texCoord = texCoordOf(*info);
    const tinygltf::Texture& texture = document_.model.textures[static_cast<std::size_t>(index)];
    const int image = imageOf(document_, static_cast<std::size_t>(index), findings_);
    if (image < 0) {
      findings_.warn("The texture " + std::to_string(index) + " of the " + name_ +
                     " has no image in a supported format; it is left out.");
      return std::nullopt;
    }
    if (texCoord > 1) {
      findings_.warn("The texture " + std::to_string(index) + " of the " + name_ + " uses TEXCOORD_" +
                     std::to_string(texCoord) + ", but only 0 and 1 are read; it is left out.");
      return std::nullopt;
    }
    TextureUse use;
    use.image = image;
    use.texCoord = texCoord;
    use.transform = transformOf(*info);
    if (texture.sampler >= 0) {
      const tinygltf::Sampler& sampler = document_.model.samplers[static_cast<std::size_t>(texture.sampler)];
      use.wrapS = wrapOf(sampler.wrapS);
      use.wrapT = wrapOf(sampler.wrapT);
      use.minFilter = minFilterOf(sampler.minFilter);
      use.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return use;
  }

  const GltfDocument& document_;
  const tinygltf::Material& source_;
  const nlohmann::json& json_;
  std::string name_;
  Findings& findings_;
};

} // namespace

std::vector<Material> readMaterials(const GltfDocument& document, Findings& findings) {
  std::vector<Material> materials;
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    materials.push_back(MaterialReading(document, i, findings).read());
  }
  materials.emplace_back();
  return materials;
}

} // namespace gnomon
