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

std::vector<glm::vec2> samplesOf(const SampleGrid& grid, std::span<const std::uint32_t> pixels) {
  std::vector<glm::vec2> places;
  places.reserve(pixels.size() * grid.samples());
  for (const std::uint32_t pixel : pixels) {
    for (const glm::vec2 position : grid.positions) places.push_back(placeIn(grid, pixel, position));
  }
  return places;
}

} // namespace gnomon
