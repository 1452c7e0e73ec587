#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
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

/// Between the centres of the four texels around a place of the map, 0..1. REQUIRES: the map is not empty.
inline float shareAt(const LightMap& map, const glm::vec2& place) {
  const glm::vec2 from = glm::floor(place - 0.5f);
  const glm::vec2 part = place - 0.5f - from;
  const int x = static_cast<int>(from.x);
  const int y = static_cast<int>(from.y);
  const auto value = [&](int dx, int dy) { return static_cast<float>(map.at(x + dx, y + dy)); };
  const float below = value(0, 0) + part.x * (value(1, 0) - value(0, 0));
  const float above = value(0, 1) + part.x * (value(1, 1) - value(0, 1));
  return (below + part.y * (above - below)) * (1.0f / 65535.0f);
}

/// The same in 0..65535, faster. REQUIRES: at least two texels a side.
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

} // namespace gnomon
