#include "renderer/scene/materials/material_factors.h"

#include <nlohmann/json.hpp>

#include "renderer/scene/gltf_json.h"
#include "renderer/scene/materials/material_extensions.h"
#include "renderer/scene/materials/materials.h"

namespace gnomon {

namespace {

using nlohmann::json;

float numberAt(const json* object, const char* key, float usual) {
  const json* member = object == nullptr ? nullptr : memberOf(*object, key);
  return member == nullptr ? usual : member->get<float>();
}

glm::vec3 emissiveOf(const json& source) {
  const json* strength = extensionOf(source, "KHR_materials_emissive_strength");
  return vectorAt<3>(source, "emissiveFactor", glm::vec3(0)) * numberAt(strength, "emissiveStrength", 1);
}

void readAlpha(const json& source, const std::string& name, Material& material, Findings& findings) {
  const std::string mode = source.value("alphaMode", "OPAQUE");
  if (mode == "MASK") {
    material.alphaMode = AlphaMode::mask;
    material.alphaCutoff = source.value("alphaCutoff", 0.5f);
  } else if (mode == "BLEND") {
    material.alphaMode = AlphaMode::blend;
    material.alphaCutoff = 0.5f;
    findings.warn("The " + name + " is blended; the camera sees it solid where its alpha is at least 0.5.");
  }
}

} // namespace

Material readFactors(const json& source, const std::string& name, Findings& findings) {
  Material material;
  material.name = nameOf(source);
  if (const json* pbr = memberOf(source, "pbrMetallicRoughness")) {
    material.baseColorFactor = vectorAt<4>(*pbr, "baseColorFactor", glm::vec4(1));
    material.metallicFactor = numberAt(pbr, "metallicFactor", 1);
    material.roughnessFactor = numberAt(pbr, "roughnessFactor", 1);
  }
  material.normalScale = numberAt(memberOf(source, "normalTexture"), "scale", 1);
  material.occlusionStrength = numberAt(memberOf(source, "occlusionTexture"), "strength", 1);
  material.emissiveFactor = emissiveOf(source);
  material.doubleSided = source.value("doubleSided", false);
  readAlpha(source, name, material, findings);
  if (const json* glossy = extensionOf(source, "KHR_materials_pbrSpecularGlossiness")) {
    readSpecularGlossiness(*glossy, material);
  }
  material.unlit = extensionOf(source, "KHR_materials_unlit") != nullptr;
  if (const json* transmission = extensionOf(source, "KHR_materials_transmission")) {
    readTransmission(*transmission, name, material, findings);
  }
  return material;
}

std::array<const json*, 5> textureInfosOf(const json& source) {
  const json* glossy = extensionOf(source, "KHR_materials_pbrSpecularGlossiness");
  const json* pbr = memberOf(source, "pbrMetallicRoughness");
  const json* color = glossy != nullptr ? memberOf(*glossy, "diffuseTexture")
                      : pbr != nullptr  ? memberOf(*pbr, "baseColorTexture")
                                        : nullptr;
  const json* surface = glossy != nullptr ? memberOf(*glossy, "specularGlossinessTexture")
                        : pbr != nullptr  ? memberOf(*pbr, "metallicRoughnessTexture")
                                          : nullptr;
  return {color, surface, memberOf(source, "normalTexture"), memberOf(source, "occlusionTexture"),
          memberOf(source, "emissiveTexture")};
}

Material repainted(const Material& loaded, const json& source) {
  Findings said; // when the file was loaded
  Material material = readFactors(source, {}, said);
  material.hasVertexColors = loaded.hasVertexColors;
  Material textured = loaded;
  const auto from = texturesOf(textured);
  const auto to = texturesOf(material);
  const auto infos = textureInfosOf(source);
  for (std::size_t i = 0; i < infos.size(); ++i) {
    *to[i] = *from[i];
    if (*to[i]) (*to[i])->transform = transformOf(*infos[i]);
  }
  return material;
}

} // namespace gnomon
