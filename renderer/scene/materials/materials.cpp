#include "renderer/scene/materials/materials.h"

#include "renderer/scene/gltf_json.h"
#include "renderer/scene/materials/material_extensions.h"
#include "renderer/scene/materials/material_factors.h"

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

class MaterialReading {
 public:
  MaterialReading(const GltfDocument& document, std::size_t index, Findings& findings)
      : document_(document),
        json_(document.json.at("materials")[index]),
        name_(nameOfMaterial(index, nameOf(json_))),
        findings_(findings) {}

  Material read() const {
    Material material = readFactors(json_, name_, findings_);
    const auto textures = texturesOf(material);
    const auto infos = textureInfosOf(json_);
    for (std::size_t i = 0; i < infos.size(); ++i) {
      if (infos[i] != nullptr) *textures[i] = texture(*infos[i]);
    }
    return material;
  }

 private:
  /// The texture that a textureInfo names; nothing, and a warning, where it can't be drawn.
  std::optional<TextureUse> texture(const nlohmann::json& info) const {
    const int index = info.at("index").get<int>();
    const tinygltf::Texture& texture = document_.model.textures[static_cast<std::size_t>(index)];
    const int image = imageOf(document_, static_cast<std::size_t>(index), findings_);
    if (image < 0) {
      findings_.warn("The texture " + std::to_string(index) + " of the " + name_ +
                     " has no image in a supported format; it is left out.");
      return std::nullopt;
    }
    TextureUse use;
    use.image = image;
    use.texCoord = texCoordOf(info);
    use.transform = transformOf(info);
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
  const nlohmann::json& json_;
  std::string name_;
  Findings& findings_;
};

} // namespace

std::string nameOfMaterial(std::size_t index, const std::string& name) {
  return "material " + std::to_string(index) + (name.empty() ? "" : " " + inQuotes(name));
}

std::vector<Material> readMaterials(const GltfDocument& document, Findings& findings) {
  std::vector<Material> materials;
  const auto sources = document.json.find("materials");
  for (std::size_t i = 0; sources != document.json.end() && i < sources->size(); ++i) {
    materials.push_back(MaterialReading(document, i, findings).read());
  }
  materials.emplace_back();
  return materials;
}

} // namespace gnomon
