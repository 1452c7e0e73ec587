#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/findings.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The file's materials, and after them the default material. Their textures name the file's images and texture
/// coordinates by its own numbers; loadImages() and placeUvSets() make them name the scene's.
std::vector<Material> readMaterials(const GltfDocument& document, Findings& findings);

/// As it stands in warnings.
std::string nameOfMaterial(std::size_t index, const std::string& name);

/// Every place in a material where a texture may stand.
inline std::array<std::optional<TextureUse>*, 5> texturesOf(Material& material) {
  return {&material.baseColor, &material.metallicRoughness, &material.normal, &material.occlusion, &material.emissive};
}

} // namespace gnomon
