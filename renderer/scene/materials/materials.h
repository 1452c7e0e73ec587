#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

/// The materials of a file, and its KHR_materials_variants: other materials for its primitives.
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

/// Refuses a file whose variants and primitives give more choices than maxInstances.
void checkVariantCount(const gltf::Model& model, const Limits& limits, Findings& findings);

/// The materials of a primitive, as in Primitive::variantMaterials.
std::vector<int> variantMaterials(const gltf::Model& model, const gltf::Primitive& primitive);

/// The views again for each of scene.variants, with its materials.
std::vector<SceneView> variantViews(const Scene& scene, const std::vector<SceneView>& views);

/// Adds the scenes of the file again for each of scene.variants, with its materials. Refuses what would take the placed
/// primitives past maxInstances.
void addVariantScenes(const Limits& limits, Scene& scene, Findings& findings);

} // namespace gnomon
