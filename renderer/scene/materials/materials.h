#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The file's materials, and after them the default material. Their textures name the file's images and texture
/// coordinates by its own numbers; loadImages() and placeUvSets() make them name the scene's.
std::vector<Material> readMaterials(const gltf::Model& model, Findings& findings);

/// A loaded material with the numbers of `source`: the textures stay, how they are laid does not.
Material repainted(const Material& loaded, const gltf::Material& source);

/// How a texture is laid; nothing where it lies as it is.
std::optional<TextureTransform> transformOf(const gltf::TextureInfo& info);

/// As it stands in warnings.
std::string nameOfMaterial(std::size_t index, const std::string& name);

/// Every place in a material where a texture may stand.
inline std::array<std::optional<TextureUse>*, 5> texturesOf(Material& material) {
  return {&material.baseColor, &material.metallicRoughness, &material.normal, &material.occlusion, &material.emissive};
}

} // namespace gnomon
