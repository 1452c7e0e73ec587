#include "renderer/scene/materials/uv_sets.h"

#include <algorithm>
#include <array>

#include "renderer/scene/materials/materials.h"

namespace gnomon {

namespace {

/// In the order of texturesOf().
constexpr std::array kTextureNames{"base color", "metallic-roughness", "normal", "occlusion", "emissive"};

void leaveOut(std::size_t material, std::size_t texture, const std::string& why, std::vector<Material>& materials,
              Findings& findings) {
  Material& from = materials[material];
  findings.warn("The " + std::string(kTextureNames[texture]) + " texture of the " +
                nameOfMaterial(material, from.name) + " " + why + "; it is left out.");
  texturesOf(from)[texture]->reset();
}

UvSets placeIn(std::size_t index, std::vector<Material>& materials, Findings& findings) {
  const auto textures = texturesOf(materials[index]);
  std::vector<int> used;
  for (const auto* texture : textures) {
    if (*texture) used.push_back((*texture)->texCoord);
  }
  const UvSets sets = uvSetsFor(used);
  for (std::size_t i = 0; i < textures.size(); ++i) {
    if (!*textures[i]) continue;
    int& texCoord = (*textures[i])->texCoord;
    const auto place = std::find(sets.begin(), sets.end(), texCoord);
    if (place != sets.end()) {
      texCoord = static_cast<int>(place - sets.begin());
    } else {
      leaveOut(index, i, "uses TEXCOORD_" + std::to_string(texCoord) + ", a third set of texture coordinates",
               materials, findings);
    }
  }
  return sets;
}

/// Takes from a variant's material what it reads where the primitive holds something else.
void agree(const UvSets& held, std::size_t variant, std::vector<Material>& materials, UvSets& sets,
           Findings& findings) {
  const auto textures = texturesOf(materials[variant]);
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    if (held[slot] < 0 || sets[slot] < 0 || held[slot] == sets[slot]) continue;
    for (std::size_t i = 0; i < textures.size(); ++i) {
      if (!*textures[i] || (*textures[i])->texCoord != static_cast<int>(slot)) continue;
      leaveOut(variant, i,
               "uses TEXCOORD_" + std::to_string(sets[slot]) +
                   ", which a primitive that uses it as a variant has no room for",
               materials, findings);
    }
    sets[slot] = -1;
  }
}

} // namespace

UvSets uvSetsFor(std::span<const int> used) {
  if (used.empty()) return {-1, -1};
  const int first = used.front();
  const auto other = std::find_if(used.begin(), used.end(), [&](int set) { return set != first; });
  if (other == used.end()) return first == 0 ? UvSets{0, -1} : UvSets{-1, first};
  const auto [low, high] = std::minmax(first, *other);
  return low == 1 ? UvSets{high, 1} : UvSets{low, high};
}

std::optional<UvSets> sharedUvSets(const UvSets& a, const UvSets& b) {
  UvSets shared{};
  for (std::size_t slot = 0; slot < shared.size(); ++slot) {
    if (a[slot] >= 0 && b[slot] >= 0 && a[slot] != b[slot]) return std::nullopt;
    shared[slot] = std::max(a[slot], b[slot]);
  }
  return shared;
}

std::vector<UvSets> placeUvSets(const gltf::Model& model, std::vector<Material>& materials, Findings& findings) {
  std::vector<UvSets> sets;
  bool anyFurther = false;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    sets.push_back(placeIn(i, materials, findings));
    anyFurther = anyFurther || std::max(sets.back()[0], sets.back()[1]) > 1;
  }
  if (!anyFurther) return sets;
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    const auto& primitives = model.meshes[m].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const int own = primitives[p].material;
      UvSets held = own < 0 ? UvSets{-1, -1} : sets[static_cast<std::size_t>(own)];
      for (const int variant : variantMaterials(model, primitives[p])) {
        if (variant < 0) continue;
        UvSets& wanted = sets[static_cast<std::size_t>(variant)];
        if (!sharedUvSets(held, wanted)) agree(held, static_cast<std::size_t>(variant), materials, wanted, findings);
        held = *sharedUvSets(held, wanted);
      }
    }
  }
  return sets;
}

UvSets uvSetsOf(int material, const std::vector<int>& variantMaterials, const std::vector<UvSets>& sets) {
  UvSets held{-1, -1};
  const auto add = [&](int index) {
    if (index >= 0) held = sharedUvSets(held, sets[static_cast<std::size_t>(index)]).value_or(held);
  };
  add(material);
  for (const int variant : variantMaterials) add(variant);
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    if (held[slot] < 0) held[slot] = static_cast<int>(slot);
  }
  return held;
}

} // namespace gnomon
