#pragma once

#include <glm/glm.hpp>

#include "renderer/bake/light_map.h"

namespace gnomon::testing {

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

} // namespace gnomon::testing
