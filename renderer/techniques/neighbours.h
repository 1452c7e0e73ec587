#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/core/vectors.h"
#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// Rows that one core looks through at a time.
inline constexpr std::size_t kScanRows = 64;

/// The places where `marks` is not 0, each plus `first`; most are taken to be 0.
inline void appendMarked(std::span<const std::uint8_t> marks, std::size_t first, std::vector<std::uint32_t>& places) {
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

/// Values of three rows of `width` pixels that follow each other.
struct ThreeRows {
  const std::uint8_t* below;
  const std::uint8_t* own;
  const std::uint8_t* above;
};

/// The least and the most of the values of each pixel of the row in the middle and of those next to it and to its
/// corners. `least`, `most`: `width` + 2 values each, of which the first `width` are meant.
void extremesAround(const ThreeRows& rows, std::size_t width, std::uint8_t* least, std::uint8_t* most);

/// Calls `each(row, least, most)` for every row of a picture, on all cores: with the least and the most of the values
/// of each pixel of the row and of those next to it and to its corners, which it may overwrite. `values`: one a pixel.
template <class Each>
void forEachRowAround(const SampleGrid& grid, std::span<const std::uint8_t> values, Each each) {
  const auto height = static_cast<std::size_t>(grid.height);
  forEachPiece(height, kScanRows, [&](std::size_t first, std::size_t last) {
    const auto width = static_cast<std::size_t>(grid.width); // in here no byte that is written may change it
    std::vector<std::uint8_t> lows(width + 2);
    std::vector<std::uint8_t> highs(width + 2);
    for (std::size_t row = first; row < last; ++row) {
      const std::uint8_t* own = values.data() + row * width;
      extremesAround({row > 0 ? own - width : own, own, row + 1 < height ? own + width : own}, width, lows.data(),
                     highs.data());
      each(row, std::span(lows).first(width), std::span(highs).first(width));
    }
  });
}

/// The pixels for which `keep(least, most)` holds, in order: of the values of the pixel and of those next to it and to
/// its corners. `values`: one a pixel. On all cores.
template <class Keep>
std::vector<std::uint32_t> pixelsWhere(const SampleGrid& grid, std::span<const std::uint8_t> values, Keep keep) {
  std::vector<std::vector<std::uint32_t>> found((static_cast<std::size_t>(grid.height) + kScanRows - 1) / kScanRows);
  forEachRowAround(grid, values, [&](std::size_t row, std::span<std::uint8_t> least, std::span<std::uint8_t> most) {
    const std::size_t width = least.size();
    std::uint8_t* mark = least.data();
    const std::uint8_t* high = most.data();
    for (std::size_t x = 0; x < width; ++x) mark[x] = keep(mark[x], high[x]) ? 1 : 0;
    appendMarked(least, row * width, found[row / kScanRows]);
  });
  std::vector<std::uint32_t> pixels;
  for (const std::vector<std::uint32_t>& some : found) pixels.insert(pixels.end(), some.begin(), some.end());
  return pixels;
}

/// In bytes, many at a time.
inline bool areApart(std::uint8_t least, std::uint8_t most, std::uint8_t apart) {
  return static_cast<std::uint8_t>(most - least) >= apart;
}

/// The pixels whose value, or one beside or at a corner of which, differs by `apart` or more from another of these.
inline std::vector<std::uint32_t> pixelsApart(const SampleGrid& grid, std::span<const std::uint8_t> values,
                                              std::uint8_t apart) {
  return pixelsWhere(grid, values,
                     [apart](std::uint8_t least, std::uint8_t most) { return areApart(least, most, apart); });
}

/// The same as a byte a pixel, not 0 for those.
inline UnfilledVector<std::uint8_t> marksApart(const SampleGrid& grid, std::span<const std::uint8_t> values,
                                               std::uint8_t apart) {
  UnfilledVector<std::uint8_t> marks(grid.pixels());
  forEachRowAround(grid, values, [&](std::size_t row, std::span<std::uint8_t> least, std::span<std::uint8_t> most) {
    const std::size_t width = least.size();
    const std::uint8_t* low = least.data();
    const std::uint8_t* high = most.data();
    std::uint8_t* mark = marks.data() + row * width;
    for (std::size_t x = 0; x < width; ++x) mark[x] = areApart(low[x], high[x], apart) ? 1 : 0;
  });
  return marks;
}

} // namespace gnomon
