#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "renderer/environment/environment_map.h"

namespace gnomon::testing {

inline EnvironmentMap uniformMap(int height, const glm::vec3& radiance) {
  const auto count = 2 * static_cast<std::size_t>(height) * static_cast<std::size_t>(height);
  return {2 * height, height, std::vector<glm::vec3>(count, radiance)};
}

/// Black but for one texel.
inline EnvironmentMap oneTexelMap(int height, int x, int y, const glm::vec3& radiance) {
  EnvironmentMap map = uniformMap(height, glm::vec3(0));
  map.texels[static_cast<std::size_t>(y * map.width + x)] = radiance;
  return map;
}

/// Each texel by itself, and some of them a hundred times as bright.
inline EnvironmentMap noisyMap(int height) {
  EnvironmentMap map = uniformMap(height, glm::vec3(0));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> share(0, 1);
  for (glm::vec3& texel : map.texels) {
    texel = glm::vec3(share(random), share(random), share(random));
    if (share(random) < 0.002f) texel *= 100.0f;
  }
  return map;
}

/// Towards the middle of a texel.
inline glm::dvec3 texelDirection(const EnvironmentMap& map, int x, int y) {
  return environmentDirection({(x + 0.5) / map.width, (y + 0.5) / map.height});
}

/// Evenly spread over the sphere, none on a corner or an edge of a map.
inline std::vector<glm::vec3> spreadDirections(int count) {
  std::vector<glm::vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double up = 1 - 2 * (i + 0.5) / count;
    const double across = std::sqrt(1 - up * up);
    const double turn = 2.399963229728653 * i + 0.1234;
    directions.emplace_back(across * std::cos(turn), up, across * std::sin(turn));
  }
  return directions;
}

} // namespace gnomon::testing
