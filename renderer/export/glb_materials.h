#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "renderer/image/image.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A GLB that grows: its JSON, and the bytes of its one buffer.
struct GlbDraft {
  nlohmann::json json;
  Bytes binary;

  /// The index of a new buffer view over these bytes, which begin at a multiple of four.
  std::size_t addView(std::span<const std::uint8_t> bytes);

  /// The index of a new image, a PNG.
  std::size_t addPng(std::span<const std::uint8_t> png);
};

/// Adds every material of the scene that `used` marks, with its textures, and the map to all that show light. Index of
/// each in the draft, one a material of the scene; -1 = not used. `map`: index of the map's texture; `intensity`: what
/// its values are multiplied by. Textures on the second set of coordinates move to TEXCOORD_2, since the map takes
/// TEXCOORD_1. A problem where a picture of the scene is broken.
Result<std::vector<int>> addMaterials(const Scene& scene, const std::vector<std::uint8_t>& used, std::size_t map,
                                      float intensity, GlbDraft& draft);

/// Whether a texture of the material reads this set of coordinates.
bool readsUv(const Material& material, int set);

} // namespace gnomon
