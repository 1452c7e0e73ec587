#include "renderer/scene/materials/materials.h"

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

std::string nameOf(std::size_t index, const std::string& name) {
  return "material " + std::to_string(index) + (name.empty() ? "" : " " + inQuotes(name));
}

class MaterialReading {
 public:
  MaterialReading(const tinygltf::Model& model, std::size_t index, Findings& findings)
      : model_(model),
        source_(model.materials[index]),
        name_(nameOf(index, model.materials[index].name)),
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
    material.baseColor = texture(pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord);
    material.metallicRoughness = texture(pbr.metallicRoughnessTexture.index, pbr.metallicRoughnessTexture.texCoord);
    material.normal = texture(source_.normalTexture.index, source_.normalTexture.texCoord);
    material.occlusion = texture(source_.occlusionTexture.index, source_.occlusionTexture.texCoord);
    material.emissive = texture(source_.emissiveTexture.index, source_.emissiveTexture.texCoord);
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

  std::optional<TextureUse> texture(int index, int texCoord) const {
    if (index < 0) return std::nullopt;
    const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(index)];
    if (texture.source < 0) {
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
    use.image = texture.source;
    use.texCoord = texCoord;
    if (texture.sampler >= 0) {
      const tinygltf::Sampler& sampler = model_.samplers[static_cast<std::size_t>(texture.sampler)];
      use.wrapS = wrapOf(sampler.wrapS);
      use.wrapT = wrapOf(sampler.wrapT);
      use.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return use;
  }

  const tinygltf::Model& model_;
  const tinygltf::Material& source_;
  std::string name_;
  Findings& findings_;
};

} // namespace

std::vector<Material> readMaterials(const GltfDocument& document, Findings& findings) {
  std::vector<Material> materials;
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    materials.push_back(MaterialReading(document.model, i, findings).read());
  }
  materials.emplace_back();
  return materials;
}

} // namespace gnomon
