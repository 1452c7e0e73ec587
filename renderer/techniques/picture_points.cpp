#include "renderer/techniques/picture_points.h"

#include <algorithm>

#include "renderer/techniques/neighbours.h"

namespace gnomon {

std::vector<SurfacePoint> PicturePoints::drawn(std::span<const std::uint32_t> pixels) const {
  std::vector<glm::vec2> places(pixels.size());
  std::vector<std::uint32_t> numbers(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    places[i] = placeIn(grid_, pixels[i], grid_.positions.front());
    numbers[i] = shown_[pixels[i] * grid_.samples()];
  }
  std::vector<SurfacePoint> points(pixels.size());
  pointsOn(rays_, places, numbers_.of(numbers), points);
  return points;
}

std::vector<SurfacePoint> PicturePoints::traced(std::span<const std::uint32_t> pixels) const {
  const std::vector<glm::vec2> places = samplesOf(grid_, pixels);
  std::vector<SurfacePoint> points(places.size());
  camera_.firstHits(places, points);
  return points;
}

std::vector<std::uint32_t> PicturePoints::besideMasks() const {
  if (masks_.empty()) return {};
  return pixelsWhere(grid_, masks_, [](std::uint8_t /*least*/, std::uint8_t most) { return most != 0; });
}

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
  return static_cast<std::uint16_t>(double{std::clamp(share, 0.0f, 1.0f) * 65535.0f} + 0.5);
}

std::uint8_t unorm8(float share) {
  return static_cast<std::uint8_t>(double{std::clamp(share, 0.0f, 1.0f) * 255.0f} + 0.5);
}

} // namespace gnomon
