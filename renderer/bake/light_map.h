#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// What share of one light a scene's surfaces see, on the side that faces the light; where the triangles lie says a
/// LightMapLayout.
struct LightMap {
  int width = 0; ///< texels
  int height = 0;
  std::vector<std::uint16_t> shares; ///< 0..65535, row by row, y 0 first; what no surface covers is as near it

  std::uint16_t at(int x, int y) const {
    const int column = std::clamp(x, 0, width - 1);
    const int row = std::clamp(y, 0, height - 1);
    return shares[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

/// Between the centres of the four texels around a place of the map, 0..65535. REQUIRES: at least two texels a side.
inline float scaledShareAt(const LightMap& map, const glm::vec2& place) {
  const int x = std::clamp(static_cast<int>(place.x - 0.5f), 0, map.width - 2);
  const int y = std::clamp(static_cast<int>(place.y - 0.5f), 0, map.height - 2);
  const float right = std::clamp(place.x - 0.5f - static_cast<float>(x), 0.0f, 1.0f);
  const float up = std::clamp(place.y - 0.5f - static_cast<float>(y), 0.0f, 1.0f);
  const auto width = static_cast<std::size_t>(map.width);
  const std::uint16_t* low = map.shares.data() + static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
  const std::uint16_t* high = low + width;
  const float below = static_cast<float>(low[0]) + right * static_cast<float>(low[1] - low[0]);
  const float above = static_cast<float>(high[0]) + right * static_cast<float>(high[1] - high[0]);
  return below + up * (above - below);
}

/// Blocks of a light map with one value: most of it is lit or dark as a whole, so that few bytes suffice.
struct EvenBlocks {
  static constexpr int kSide = 8;             ///< texels
  static constexpr std::uint16_t kUneven = 1; ///< a share that no block is said to have
  int columns = 0;                            ///< blocks
  std::vector<std::uint16_t> shares;          ///< row by row; behind the last one more, which means nothing

  std::size_t bytes() const { return shares.capacity() * sizeof(shares[0]); }
};

/// Of each block the share that all of its texels have, and those beside it to the right and above, so that it is what
/// is read anywhere between them; else kUneven.
EvenBlocks evenBlocks(const LightMap& map);

/// Of each triangle the share that is read anywhere in it, if that is one; else EvenBlocks::kUneven. Behind the last
/// one more, which means nothing. `even`: of the map; `corners`: three a triangle, texels.
std::vector<std::uint16_t> evenTriangles(const LightMap& map, const EvenBlocks& even,
                                         std::span<const glm::vec2> corners);

} // namespace gnomon
