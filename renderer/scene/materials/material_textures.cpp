#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "protocol/base/bytes.h"
#include "renderer/core/stop.h"
#include "renderer/image/image_codec.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/materials/materials.h"
#include "renderer/scene/shared_content.h"

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

using Encoded = std::span<const std::uint8_t>;

/// The name of a known format that is not decoded; empty for those that are, and for bytes of no known format.
std::string_view unsupportedFormat(Encoded bytes) {
  if (asText(bytes).starts_with("\xABKTX 20\xBB")) return "KTX 2";
  if (asText(bytes).starts_with("DDS ")) return "DDS";
  return {};
}

std::string imageName(const GltfDocument& document, int index) {
  const auto& name = document.model.images[static_cast<std::size_t>(index)].name;
  return "image " + std::to_string(index) + (name ? ' ' + inQuotes(*name) : "");
}

const char* const kLeftOut = "the textures that use it are left out";

void leaveOut(Problems problems, const std::string& pointer, Findings& findings) {
  Findings image;
  image.take(locatedImageProblems(std::move(problems), pointer));
  findings.leaveOut(std::move(image), kLeftOut);
}

/// Reports unused images that can't be read.
void checkUnused(const GltfDocument& document, const std::map<int, int>& used, Findings& findings) {
  for (std::size_t i = 0; i < document.images.size(); ++i) {
    const Encoded bytes = document.images[i].view();
    if (bytes.empty() || used.contains(static_cast<int>(i)) || !unsupportedFormat(bytes).empty()) continue;
    auto size = imageSize(bytes);
    if (!size) leaveOut(std::move(size).problems(), pointerTo("/images", i), findings);
  }
}

/// The images of the file that a material uses; -1 = it is left out, else its place in Scene::images, yet to be found.
std::map<int, int> usedImages(const GltfDocument& document, std::vector<Material>& materials, Findings& findings) {
  std::map<int, int> slots;
  for (Material& material : materials) {
    for (const auto* texture : texturesOf(material)) {
      if (*texture) slots.emplace((*texture)->image, -1);
    }
  }
  for (auto& [image, slot] : slots) {
    const Encoded bytes = document.images[static_cast<std::size_t>(image)].view();
    const std::string_view format = unsupportedFormat(bytes);
    if (bytes.empty()) {
      continue; // reported where it is missing
    } else if (format.empty()) {
      slot = 0; // found its place once it has been checked
    } else {
      findings.warn("The " + imageName(document, image) + " is " + std::string(format) +
                    ", which is not supported; the textures that use it are left out.");
    }
  }
  return slots;
}

/// Holds the images against the limits; those without a size are left out.
void checkSizes(const GltfDocument& document, std::map<int, int>& slots, const Limits& limits, Findings& findings) {
  std::int64_t pixels = 0;
  for (auto& [image, slot] : slots) {
    if (slot < 0) continue;
    const std::string pointer = pointerTo("/images", static_cast<std::size_t>(image));
    auto size = imageSize(document.images[static_cast<std::size_t>(image)].view());
    if (!size) {
      leaveOut(std::move(size).problems(), pointer, findings);
      slot = -1;
      continue;
    }
    const std::string actual = std::to_string(size->width) + " x " + std::to_string(size->height);
    if (size->width > limits.maxImageSide || size->height > limits.maxImageSide) {
      findings.tooLarge(pointer, "The image is too large.", std::to_string(limits.maxImageSide) + " a side", actual);
      continue;
    }
    pixels += std::int64_t{size->width} * size->height;
    if (pixels > limits.maxImagePixels) {
      findings.tooLarge(pointer, "The images have too many pixels together.", std::to_string(limits.maxImagePixels),
                        std::to_string(pixels));
      return;
    }
  }
}

/// SHA-256 of an image and of its place in the file, which its problems name.
std::string imageContent(Encoded bytes, const std::string& pointer) {
  Sha256 hash;
  hash.add(pointer);
  hash.add(std::string_view("\0", 1));
  hash.add(bytes);
  return hash.hex();
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

SceneImages loadImages(const GltfDocument& document, const Limits& limits, std::vector<Material>& materials,
                       Findings& findings, KnownContent* known) {
  std::map<int, int> slots = usedImages(document, materials, findings);
  checkUnused(document, slots, findings);
  checkSizes(document, slots, limits, findings);
  SceneImages images;
  if (findings.refused()) return images;
  for (auto& [image, slot] : slots) {
    if (slot < 0) continue;
    stopIfAsked();
    const std::string pointer = pointerTo("/images", static_cast<std::size_t>(image));
    const Encoded bytes = document.images[static_cast<std::size_t>(image)].view();
    const std::string content = known != nullptr ? imageContent(bytes, pointer) : std::string();
    auto picture = known != nullptr ? known->image(content) : nullptr;
    if (!picture) {
      auto checked = checkImage(bytes, limits.maxImageSide, limits.maxImagePixels);
      if (!checked) {
        leaveOut(std::move(checked).problems(), pointer, findings);
        slot = -1;
        continue;
      }
      picture = std::make_shared<const SceneImage>(*std::move(checked), pointer);
      if (known != nullptr) known->keepImage(content, picture);
    }
    if (picture->cutShort()) findings.repair({"An image is cut short", "what it has is drawn"}, pointer);
    slot = static_cast<int>(images.size());
    images.push_back(std::move(picture));
  }
  for (Material& material : materials) {
    for (auto* texture : texturesOf(material)) {
      if (!*texture) continue;
      const int slot = slots.at((*texture)->image);
      if (slot < 0) {
        texture->reset();
      } else {
        (*texture)->image = slot;
      }
    }
  }
  return images;
}

} // namespace gnomon
