#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/core/vectors.h"

namespace gnomon::cpu {

/// Pixels or texels along a side of a block: its 16 places are the lanes of one vector.
inline constexpr int kBlockSide = 4;
inline constexpr int kBlockPlaces = kBlockSide * kBlockSide;

/// What was rastered: a depth and, for a camera, a triangle for each sample of each place. Rows count from the BOTTOM,
/// as in clip space. Stored block by block, so that a block's 16 places of one sample lie side by side.
struct DepthBuffer {
  int width = 0; ///< places; those beyond it, to the end of the last block, are rastered and mean nothing
  int height = 0;
  int samples = 1; ///< a place: 1 or 4
  UnfilledVector<float> depths{};
  UnfilledVector<std::uint32_t> triangles{}; ///< parallel to depths; empty = not asked for

  int blocksAcross() const { return (width + kBlockSide - 1) / kBlockSide; }
  int blocksUp() const { return (height + kBlockSide - 1) / kBlockSide; }
  std::size_t blocks() const { return static_cast<std::size_t>(blocksAcross()) * static_cast<std::size_t>(blocksUp()); }
  /// Values of all samples.
  std::size_t places() const { return blocks() * static_cast<std::size_t>(samples) * kBlockPlaces; }

  /// Where the 16 places of a block lie: that many values of a sample follow each other, row by row.
  std::size_t blockAt(int column, int row, int sample = 0) const {
    const auto block =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(blocksAcross()) + static_cast<std::size_t>(column);
    return (block * static_cast<std::size_t>(samples) + static_cast<std::size_t>(sample)) * kBlockPlaces;
  }
  std::size_t at(int x, int y, int sample = 0) const {
    return blockAt(x / kBlockSide, y / kBlockSide, sample) +
           static_cast<std::size_t>((y % kBlockSide) * kBlockSide + x % kBlockSide);
  }
};

} // namespace gnomon::cpu
