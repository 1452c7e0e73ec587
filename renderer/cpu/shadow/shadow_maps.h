#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/rect.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/prepare/frame_geometry.h"
#include "renderer/shaders/shared/frame_types.h"

namespace gnomon::cpu {

/// What was drawn into one tile. Both buffers hold the tile's texels alone, from its own lowest corner.
struct TileMap {
  Rect rect;                               ///< in the atlas
  const DepthBuffer* depths = nullptr;     ///< null = the tile has no texels, nothing is looked up in it
  std::span<const glm::vec4> moments = {}; ///< row by row from the BOTTOM; empty = its light's filter reads none
};

/// A light map, as kernels look it up by the triangle that a place shows. At least two texels a side.
struct BakedMap {
  const std::uint16_t* shares = nullptr; ///< of 65535, row by row, y 0 first
  int width = 0;                         ///< texels
  int height = 0;
  const std::uint16_t* even = nullptr;          ///< EvenBlocks of it
  int evenColumns = 0;                          ///< blocks
  const std::uint16_t* evenTriangles = nullptr; ///< as BakedLight has them
  const glm::vec2* corners = nullptr;           ///< three a triangle, texels
  std::vector<std::int32_t> firstTriangles;     ///< of each slot its first triangle's number in the map

  /// Of a triangle of the scene, in the map.
  std::size_t numberOf(std::uint32_t triangle) const {
    return static_cast<std::size_t>(firstTriangles[triangle / kClusterTriangles]) + triangle % kClusterTriangles;
  }
};

/// What is known of one light: shares of 65535, each pixel's samples side by side, row by row from the BOTTOM. Where
/// there is an odd number of them, one more may be read, which means nothing.
struct Layer {
  const std::uint16_t* values = nullptr;
  int width = 0;                   ///< pixels
  int samples = 1;                 ///< a pixel: 1 to 4
  const BakedMap* baked = nullptr; ///< is looked up instead, where there is one
};

/// What the scene hides of an environment: four shares of 65535 a sample (SkyShadow::values), in the order of Layer.
struct SkyLayer {
  const std::uint16_t* values = nullptr; ///< null = nothing is hidden
  int width = 0;                         ///< pixels
  int samples = 1;                       ///< a pixel: 1 to 4
};

inline constexpr auto kTints = [] {
  using glm::vec3;
  return std::array{GNOMON_TINTS_0_3, GNOMON_TINTS_4_7};
}();
static_assert(kTints.size() == GNOMON_LIGHT_TILES);

/// What the lights of a frame are shadowed by.
struct ShadowMaps {
  std::span<const shared::LightData> lights;
  std::span<const shared::TileData> tiles;
  std::span<const TileMap> maps; ///< parallel to tiles
  glm::vec2 atlasTexels{1};      ///< width and height of the atlas
  std::span<const Layer> layers = {};
  int volumeLight = -1; ///< the light that volumes take a share of; -1 = none
  Layer volumes = {};   ///< the share that they let through
};

} // namespace gnomon::cpu
