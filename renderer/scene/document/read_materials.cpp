#include "renderer/scene/document/read_model.h"

namespace gnomon {

namespace {

using nlohmann::json;

std::optional<gltf::TextureInfo> textureInfoAt(const json& object, const char* key) {
  const json* info = memberOf(object, key);
  return info == nullptr ? std::nullopt : std::optional(readTextureInfo(*info));
}

void readPbr(const json& pbr, gltf::Material& material) {
  material.baseColorFactor = vectorAt<4>(pbr, "baseColorFactor").value_or(glm::dvec4(1));
  material.metallicFactor = pbr.value("metallicFactor", 1.0);
  material.roughnessFactor = pbr.value("roughnessFactor", 1.0);
  material.baseColorTexture = textureInfoAt(pbr, "baseColorTexture");
  material.metallicRoughnessTexture = textureInfoAt(pbr, "metallicRoughnessTexture");
}

gltf::SpecularGlossiness readSpecularGlossiness(const json& extension) {
  return {vectorAt<4>(extension, "diffuseFactor").value_or(glm::dvec4(1)),
          vectorAt<3>(extension, "specularFactor").value_or(glm::dvec3(1)), extension.value("glossinessFactor", 1.0),
          textureInfoAt(extension, "diffuseTexture"), textureInfoAt(extension, "specularGlossinessTexture")};
}

constexpr std::array<std::string_view, 3> kAlphaModes{"OPAQUE", "MASK", "BLEND"};

} // namespace

gltf::TextureInfo readTextureInfo(const json& source) {
  gltf::TextureInfo info;
  info.texture = source.value("index", 0);
  info.texCoord = source.value("texCoord", 0);
  if (const json* extension = extensionOf(source, "KHR_texture_transform")) {
    info.texCoord = extension->value("texCoord", info.texCoord);
    info.transform = gltf::TextureTransform{vectorAt<2>(*extension, "offset").value_or(glm::dvec2(0)),
                                            extension->value("rotation", 0.0),
                                            vectorAt<2>(*extension, "scale").value_or(glm::dvec2(1))};
  }
  return info;
}

gltf::Material readMaterial(const json& source) {
  gltf::Material material;
  material.name = nameAt(source);
  if (const json* pbr = memberOf(source, "pbrMetallicRoughness")) readPbr(*pbr, material);
  if (const json* normal = memberOf(source, "normalTexture")) {
    material.normalTexture = readTextureInfo(*normal);
    material.normalScale = normal->value("scale", 1.0);
  }
  if (const json* occlusion = memberOf(source, "occlusionTexture")) {
    material.occlusionTexture = readTextureInfo(*occlusion);
    material.occlusionStrength = occlusion->value("strength", 1.0);
  }
  material.emissiveTexture = textureInfoAt(source, "emissiveTexture");
  material.emissiveFactor = vectorAt<3>(source, "emissiveFactor").value_or(glm::dvec3(0));
  if (const json* strength = extensionOf(source, "KHR_materials_emissive_strength")) {
    material.emissiveStrength = strength->value("emissiveStrength", 1.0);
  }
  material.alphaMode = namedAt(source, "alphaMode", kAlphaModes, gltf::AlphaMode::opaque);
  material.alphaCutoff = source.value("alphaCutoff", 0.5);
  material.doubleSided = source.value("doubleSided", false);
  material.unlit = extensionOf(source, "KHR_materials_unlit") != nullptr;
  if (const json* glossy = extensionOf(source, "KHR_materials_pbrSpecularGlossiness")) {
    material.specularGlossiness = readSpecularGlossiness(*glossy);
  }
  if (const json* transmission = extensionOf(source, "KHR_materials_transmission")) {
    material.transmission = gltf::Transmission{transmission->value("transmissionFactor", 0.0),
                                               textureInfoAt(*transmission, "transmissionTexture")};
  }
  return material;
}

gltf::Texture readTexture(const json& source) {
  gltf::Texture texture;
  texture.source = source.value("source", -1);
  texture.sampler = source.value("sampler", -1);
  if (const json* webp = extensionOf(source, "EXT_texture_webp")) texture.webp = webp->value("source", -1);
  texture.basisu = extensionOf(source, "KHR_texture_basisu") != nullptr;
  return texture;
}

gltf::TextureSampler readTextureSampler(const json& source) {
  gltf::TextureSampler sampler;
  sampler.wrapS = Wrap{source.value("wrapS", static_cast<int>(sampler.wrapS))};
  sampler.wrapT = Wrap{source.value("wrapT", static_cast<int>(sampler.wrapT))};
  sampler.nearest = source.value("magFilter", 0) == static_cast<int>(MinFilter::nearest);
  sampler.minFilter = MinFilter{source.value("minFilter", static_cast<int>(sampler.minFilter))};
  return sampler;
}

} // namespace gnomon
