#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "renderer/scene/findings.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/gltf_json.h"
#include "renderer/scene/scene.h"

/// What extensions say of a material or of a texture's use. The JSON has passed the schema check.
namespace gnomon {

/// The numbers of a member; `usual` where there is none.
template <int kSize>
glm::vec<kSize, float> vectorAt(const nlohmann::json& object, const char* key, glm::vec<kSize, float> usual) {
  const nlohmann::json* member = memberOf(object, key);
  if (member == nullptr) return usual;
  for (int i = 0; i < kSize; ++i) usual[i] = (*member)[static_cast<std::size_t>(i)].template get<float>();
  return usual;
}

/// KHR_texture_transform may say another set of coordinates than the textureInfo.
int texCoordOf(const nlohmann::json& textureInfo);
std::optional<TextureTransform> transformOf(const nlohmann::json& textureInfo);

/// The image of a texture: its WebP where it has one, else that in a format of glTF's own; -1 = none. Refuses a texture
/// that has nothing but KHR_texture_basisu.
int imageOf(const GltfDocument& document, std::size_t texture, Findings& findings);

/// The factors; textures are left to the caller.
void readSpecularGlossiness(const nlohmann::json& extension, Material& material);

/// After the alpha mode has been read.
void readTransmission(const nlohmann::json& extension, const std::string& name, Material& material, Findings& findings);

} // namespace gnomon
