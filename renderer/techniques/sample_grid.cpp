#include "renderer/techniques/sample_grid.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

glm::vec2 placeIn(const SampleGrid& grid, std::size_t pixel, glm::vec2 position) {
  const auto x = static_cast<float>(pixel % static_cast<std::size_t>(grid.width));
  const auto row = static_cast<float>(pixel / static_cast<std::size_t>(grid.width));
  return {x + position.x, static_cast<float>(grid.height) - (row + position.y)};
}

std::vector<glm::vec2> samplesOf(const SampleGrid& grid, std::span<const std::uint32_t> pixels) {
  std::vector<glm::vec2> places;
  places.reserve(pixels.size() * grid.samples());
  for (const std::uint32_t pixel : pixels) {
    for (const glm::vec2 position : grid.positions) places.push_back(placeIn(grid, pixel, position));
  }
  return places;
}

std::uint16_t unorm16(float share) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 65535.0f));
}

} // namespace gnomon
