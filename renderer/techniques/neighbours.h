#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// Rows that one core looks through at a time.
inline constexpr std::size_t kScanRows = 64;

/// The places where `marks` is not 0, each plus `first`; most are taken to be 0.
inline void appendMarked(const std::vector<std::uint8_t>& marks, std::size_t first,
                         std::vector<std::uint32_t>& places) {
  for (std::size_t i = 0; i < marks.size(); ++i) {
    std::uint64_t next = 0;
    while (i + sizeof next <= marks.size()) {
      std::memcpy(&next, marks.data() + i, sizeof next);
      if (next != 0) break;
      i += sizeof next;
    }
    if (i < marks.size() && marks[i] != 0) places.push_back(static_cast<std::uint32_t>(first + i));
  }
}

/// The pixels for which `keep(least, most)` holds, in order: of the values of the pixel and of those next to it and to
/// its corners. `values`: one a pixel. On all cores.
template <class Keep>
std::vector<std::uint32_t> pixelsWhere(const SampleGrid& grid, std::span<const std::uint8_t> values, Keep keep) {
  const auto height = static_cast<std::size_t>(grid.height);
  std::vector<std::vector<std::uint32_t>> found((height + kScanRows - 1) / kScanRows);
  forEachPiece(height, kScanRows, [&](std::size_t first, std::size_t last) {
    const auto width = static_cast<std::size_t>(grid.width); // in here no byte that is written may change it
    const auto least = [](std::uint8_t a, std::uint8_t b) { return a < b ? a : b; };
    const auto most = [](std::uint8_t a, std::uint8_t b) { return a > b ? a : b; };
    std::vector<std::uint8_t> lows(width + 2);
    std::vector<std::uint8_t> highs(width + 2);
    std::vector<std::uint8_t> kept(width);
    for (std::size_t row = first; row < last; ++row) {
      const std::uint8_t* below = values.data() + (row > 0 ? row - 1 : row) * width;
      const std::uint8_t* own = values.data() + row * width;
      const std::uint8_t* above = values.data() + std::min(row + 1, height - 1) * width;
      std::uint8_t* low = lows.data();
      std::uint8_t* high = highs.data();
      for (std::size_t x = 0; x < width; ++x) {
        low[x + 1] = least(least(below[x], above[x]), own[x]);
        high[x + 1] = most(most(below[x], above[x]), own[x]);
      }
      low[0] = low[1];
      high[0] = high[1];
      low[width + 1] = low[width];
      high[width + 1] = high[width];
      std::uint8_t* mark = kept.data();
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint8_t lowest = least(least(low[x], low[x + 1]), low[x + 2]);
        const std::uint8_t highest = most(most(high[x], high[x + 1]), high[x + 2]);
        mark[x] = keep(lowest, highest) ? 1 : 0;
      }
      appendMarked(kept, row * width, found[first / kScanRows]);
    }
  });
  std::vector<std::uint32_t> pixels;
  for (const std::vector<std::uint32_t>& some : found) pixels.insert(pixels.end(), some.begin(), some.end());
  return pixels;
}

} // namespace gnomon
