#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

/// glTF has any number of TEXCOORD_n, a vertex of a scene two: uv0 and uv1. Each material has its own choice of two.
namespace gnomon {

/// The n of what uv0 and uv1 hold; -1 = no texture asks for it.
using UvSets = std::array<int, 2>;

/// For the sets that a material uses, the most important first. TEXCOORD_0 is always uv0 and TEXCOORD_1 always uv1, so
/// that most materials agree. Sets after the second different one have no place.
UvSets uvSetsFor(std::span<const int> used);

/// What a primitive holds that is drawn with either material; nothing where they differ.
std::optional<UvSets> sharedUvSets(const UvSets& a, const UvSets& b);

/// One a material. Turns TextureUse::texCoord from the n of a TEXCOORD_n to 0 for uv0 and 1 for uv1. Left out with a
/// warning: textures on a third set, and those of a variant that would need another choice than the primitive's own
/// material.
std::vector<UvSets> placeUvSets(const gltf::Model& model, std::vector<Material>& materials, Findings& findings);

/// What a primitive's uv0 and uv1 are read from. `material` and `variantMaterials` as in PrimitiveSource.
UvSets uvSetsOf(int material, const std::vector<int>& variantMaterials, const std::vector<UvSets>& sets);

} // namespace gnomon
