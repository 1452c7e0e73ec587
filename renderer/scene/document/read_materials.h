#pragma once

#include <nlohmann/json_fwd.hpp>

#include "renderer/scene/document/gltf_model.h"

/// From JSON that has passed the schema check.
namespace gnomon {

gltf::TextureInfo readTextureInfo(const nlohmann::json& source);
gltf::Material readMaterial(const nlohmann::json& source);
gltf::Texture readTexture(const nlohmann::json& source);
gltf::TextureSampler readTextureSampler(const nlohmann::json& source);

} // namespace gnomon
