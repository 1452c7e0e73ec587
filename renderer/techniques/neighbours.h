#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// The pixels for which `keep(least, most)` holds: of the values of the pixel and of those next to it and to its
/// corners. `values`: one a pixel.
template <class Keep>
std::vector<std::uint32_t> pixelsWhere(const SampleGrid& grid, const std::vector<std::uint8_t>& values, Keep keep) {
  const auto width = static_cast<std::size_t>(grid.width);
  const auto height = static_cast<std::size_t>(grid.height);
  std::vector<std::uint8_t> least(width + 2);
  std::vector<std::uint8_t> most(width + 2);
  std::vector<std::uint8_t> kept(width);
  std::vector<std::uint32_t> pixels;
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* below = values.data() + (row > 0 ? row - 1 : row) * width;
    const std::uint8_t* own = values.data() + row * width;
    const std::uint8_t* above = values.data() + std::min(row + 1, height - 1) * width;
    for (std::size_t x = 0; x < width; ++x) {
      least[x + 1] = std::min(std::min(below[x], above[x]), own[x]);
      most[x + 1] = std::max(std::max(below[x], above[x]), own[x]);
    }
    least[0] = least[1];
    most[0] = most[1];
    least[width + 1] = least[width];
    most[width + 1] = most[width];
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t low = std::min(std::min(least[x], least[x + 1]), least[x + 2]);
      const std::uint8_t high = std::max(std::max(most[x], most[x + 1]), most[x + 2]);
      kept[x] = keep(low, high) ? 1 : 0;
    }
    for (auto next = kept.begin(); (next = std::find(next, kept.end(), 1)) != kept.end(); ++next) {
      pixels.push_back(static_cast<std::uint32_t>(row * width + static_cast<std::size_t>(next - kept.begin())));
    }
  }
  return pixels;
}

} // namespace gnomon
