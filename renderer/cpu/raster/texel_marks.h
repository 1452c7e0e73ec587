#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::cpu {

/// Texels along a side of the blocks that are marked together: four of DepthBuffer's.
inline constexpr int kMarkSide = 8;
/// Texels along a side of the squares whose 64 blocks are one word.
inline constexpr int kMarkSquare = 64;

/// The bits of a square's blocks from column `firstColumn` to `lastColumn` and row `firstRow` to `lastRow`, each 0..7.
/// REQUIRES: first <= last.
constexpr std::uint64_t blockBits(int firstColumn, int lastColumn, int firstRow, int lastRow) {
  const std::uint64_t columns = (0xffu >> (7 - lastColumn)) & (0xffu << firstColumn);
  const std::uint64_t rows = (~std::uint64_t{0} >> (8 * (7 - lastRow))) & (~std::uint64_t{0} << (8 * firstRow));
  return columns * 0x0101010101010101u & rows;
}

/// Which blocks of a tile's texels are meant: those that are read, or those that are made.
class TexelMarks {
 public:
  TexelMarks() = default;
  /// None. Of a tile of `width` times `height` texels.
  TexelMarks(int width, int height)
      : width_(width),
        height_(height),
        across_((width + kMarkSquare - 1) / kMarkSquare),
        squares_(static_cast<std::size_t>(across_) *
                 static_cast<std::size_t>((height + kMarkSquare - 1) / kMarkSquare)) {}

  int width() const { return width_; }
  int height() const { return height_; }

  /// Squares count row by row from the BOTTOM, as RasterView's do.
  std::uint64_t in(std::size_t square) const { return squares_[square]; }
  std::size_t squares() const { return squares_.size(); }

  /// Texels from x0, y0 to x1, y1, of which the tile has some or none.
  bool any(int x0, int y0, int x1, int y1) const;
  bool any() const;
  /// Marked blocks.
  std::size_t count() const;

  /// The same texels, and what shares a block with them. From several threads at once. REQUIRES: x0 <= x1, y0 <= y1.
  void mark(int x0, int y0, int x1, int y1) {
    if (x0 < 0 || y0 < 0 || x1 >= width_ || y1 >= height_ || (x0 ^ x1) >= kMarkSquare || (y0 ^ y1) >= kMarkSquare) {
      markInSquares(x0, y0, x1, y1);
      return;
    }
    add(static_cast<std::size_t>(y0 / kMarkSquare * across_ + x0 / kMarkSquare),
        blockBits(x0 / kMarkSide % 8, x1 / kMarkSide % 8, y0 / kMarkSide % 8, y1 / kMarkSide % 8));
  }
  void markAll();

  void add(const TexelMarks& other);
  /// The marked texels, and those as far around them as that along x and y, with what shares a block with any.
  TexelMarks grown(int x, int y) const;
  /// Those that `other` lacks.
  TexelMarks without(const TexelMarks& other) const;

 private:
  void add(std::size_t square, std::uint64_t bits) {
    const std::atomic_ref own(squares_.data()[square]);
    // Most are marked already, and looking costs less than marking.
    if ((own.load(std::memory_order_relaxed) & bits) != bits) own.fetch_or(bits, std::memory_order_relaxed);
  }
  void markInSquares(int x0, int y0, int x1, int y1);
  template <class Each>
  void forEachSquare(int x0, int y0, int x1, int y1, const Each& each) const;

  int width_ = 0, height_ = 0, across_ = 0;
  std::vector<std::uint64_t> squares_; ///< bit 8 * row + column
};

} // namespace gnomon::cpu
