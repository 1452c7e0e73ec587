#pragma once

#include <nlohmann/json_fwd.hpp>

#include "renderer/scene/document/gltf_model.h"

/// From JSON that has passed checkSchema().
namespace gnomon {

/// The typed values of a document. Takes the URIs, which may hold whole files, out of the
/// document instead of copying them.
gltf::Model readModel(nlohmann::json document);

gltf::TextureInfo readTextureInfo(const nlohmann::json& source);
gltf::Material readMaterial(const nlohmann::json& source);
gltf::Texture readTexture(const nlohmann::json& source);
gltf::TextureSampler readTextureSampler(const nlohmann::json& source);

} // namespace gnomon
