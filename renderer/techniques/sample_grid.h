#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// The samples of a picture. Pixels are counted row by row from the LOWEST row, as textures hold them; the samples of a
/// pixel lie side by side.
struct SampleGrid {
  int width = 0; ///< pixels
  int height = 0;
  std::vector<glm::vec2> positions; ///< of a pixel's samples, 0..1 from its lower left corner

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t samples() const { return positions.size(); }
};

/// Where rays go through, as firstHits takes it: from the picture's upper left corner.
glm::vec2 placeIn(const SampleGrid& grid, std::size_t pixel, glm::vec2 position);

/// Every sample of the given pixels, pixel by pixel.
std::vector<glm::vec2> samplesOf(const SampleGrid& grid, std::span<const std::uint32_t> pixels);

/// A share 0..1 as 16-bit textures hold it.
std::uint16_t unorm16(float share);

} // namespace gnomon
