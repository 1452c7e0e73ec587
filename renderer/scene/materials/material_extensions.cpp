#include "renderer/scene/materials/material_extensions.h"

#include <cmath>

namespace gnomon {

using nlohmann::json;

int texCoordOf(const json& textureInfo) {
  const json* transform = extensionOf(textureInfo, "KHR_texture_transform");
  if (transform && transform->contains("texCoord")) return transform->at("texCoord").get<int>();
  return textureInfo.value("texCoord", 0);
}

/// The extension's matrix: translation * rotation * scale, with v downwards.
std::optional<TextureTransform> transformOf(const json& textureInfo) {
  const json* extension = extensionOf(textureInfo, "KHR_texture_transform");
  if (!extension) return std::nullopt;
  const glm::vec2 scale = vectorAt<2>(*extension, "scale", glm::vec2(1));
  const double rotation = extension->value("rotation", 0.0);
  const auto c = static_cast<float>(std::cos(rotation));
  const auto s = static_cast<float>(std::sin(rotation));
  const TextureTransform transform{glm::mat2(glm::vec2(c, -s) * scale.x, glm::vec2(s, c) * scale.y),
                                   vectorAt<2>(*extension, "offset", glm::vec2(0))};
  if (transform.axes == glm::mat2(1) && transform.offset == glm::vec2(0)) return std::nullopt;
  return transform;
}

int imageOf(const GltfDocument& document, std::size_t texture, Findings& findings) {
  const json& source = document.json.at("textures")[texture];
  const json* webp = extensionOf(source, "EXT_texture_webp");
  if (webp && webp->contains("source")) return webp->at("source").get<int>();
  const int image = source.value("source", -1);
  if (image < 0 && extensionOf(source, "KHR_texture_basisu")) {
    findings.unsupported(pointerTo("/textures", texture),
                         "The texture has only a KTX 2 image (KHR_texture_basisu), which is not supported, and no "
                         "fallback image.");
  }
  return image;
}

void readSpecularGlossiness(const json& extension, Material& material) {
  material.baseColorFactor = vectorAt<4>(extension, "diffuseFactor", glm::vec4(1));
  material.specularGlossiness = SpecularGlossiness{vectorAt<3>(extension, "specularFactor", glm::vec3(1)),
                                                   extension.value("glossinessFactor", 1.0f)};
}

void readTransmission(const json& extension, const std::string& name, Material& material, Findings& findings) {
  material.transmission = extension.value("transmissionFactor", 0.0f);
  if (!(material.transmission > 0)) return;
  findings.warn("The " + name +
                " lets light through: the surroundings are seen through it, but not what stands behind it.");
  if (extension.contains("transmissionTexture")) {
    findings.warn("The transmission of the " + name + " is the same everywhere: its texture is ignored.");
  }
  const float left = 1 - material.transmission;
  if (material.alphaMode == AlphaMode::opaque) {
    material.alphaMode = AlphaMode::blend;
    material.uniformAlpha = true;
    material.baseColorFactor.a = left;
    material.alphaCutoff = 0;
  } else if (material.alphaMode == AlphaMode::blend) {
    material.baseColorFactor.a *= left;
    material.alphaCutoff *= left;
  }
}

} // namespace gnomon
