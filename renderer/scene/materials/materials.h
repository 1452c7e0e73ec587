#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

/// The materials of a file, and its KHR_materials_variants: other materials for its primitives.
namespace gnomon {

class KnownContent;
struct GltfDocument;

/// The file's materials, then the default material, with the file's numbers of images and texture coordinates until
/// loadImages() and placeUvSets().
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

/// Adds the scenes again for each of scene.variants; refuses more placed primitives than maxInstances.
void addVariantScenes(const Limits& limits, Scene& scene, Findings& findings);

// glTF has any number of TEXCOORD_n, a vertex of a scene two: uv0 and uv1. Each material has its own choice of two.

/// The n of what uv0 and uv1 hold; -1 = no texture asks for it.
using UvSets = std::array<int, 2>;

/// The choice for the sets that a material uses, the most important first; TEXCOORD_0 is always uv0 and TEXCOORD_1
/// always uv1.
UvSets uvSetsFor(std::span<const int> used);

/// What a primitive holds that is drawn with either material; nothing where they differ.
std::optional<UvSets> sharedUvSets(const UvSets& a, const UvSets& b);

/// One a material. Turns TextureUse::texCoord from n of TEXCOORD_n to 0 or 1; textures on a third set, and those of a
/// variant that needs another choice than the primitive's material, are left out with a warning.
std::vector<UvSets> placeUvSets(const gltf::Model& model, std::vector<Material>& materials, Findings& findings);

/// What a primitive's uv0 and uv1 are read from. `material` and `variantMaterials` as in PrimitiveSource.
UvSets uvSetsOf(int material, const std::vector<int>& variantMaterials, const std::vector<UvSets>& sets);

/// Checks the images that the materials use, keeps them encoded (or takes them from `known`), and points the materials'
/// textures at them; those in unsupported formats are left out with a warning.
SceneImages loadImages(const GltfDocument& document, const Limits& limits, std::vector<Material>& materials,
                       Findings& findings, KnownContent* known = nullptr);

} // namespace gnomon
