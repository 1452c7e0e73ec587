#include "renderer/techniques/picture_points.h"

#include "renderer/techniques/neighbours.h"

namespace gnomon {

std::vector<SurfacePoint> PicturePoints::drawn(std::span<const std::uint32_t> pixels) const {
  std::vector<glm::vec2> places(pixels.size());
  std::vector<std::uint32_t> numbers(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    places[i] = placeIn(grid_, pixels[i], grid_.positions.front());
    numbers[i] = shown_[pixels[i] * grid_.samples()];
  }
  return pointsOn(rays_, places, numbers_.of(numbers));
}

std::vector<SurfacePoint> PicturePoints::traced(std::span<const std::uint32_t> pixels) const {
  return firstHits(rays_, samplesOf(grid_, pixels));
}

std::vector<std::uint32_t> PicturePoints::besideMasks() const {
  if (masks_.empty()) return {};
  return pixelsWhere(grid_, masks_, [](std::uint8_t /*least*/, std::uint8_t most) { return most != 0; });
}

} // namespace gnomon
