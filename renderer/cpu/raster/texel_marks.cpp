#include "renderer/cpu/raster/texel_marks.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>

namespace gnomon::cpu {

/// Calls `each(square, bits)` for what the tile has of a rectangle of texels.
template <class Each>
void TexelMarks::forEachSquare(int x0, int y0, int x1, int y1, const Each& each) const {
  const int left = std::max(x0, 0) / kMarkSide, right = std::min(x1, width_ - 1);
  const int low = std::max(y0, 0) / kMarkSide, high = std::min(y1, height_ - 1);
  if (x0 > right || y0 > high || right < 0 || high < 0) return;
  constexpr int kBlocks = kMarkSquare / kMarkSide;
  const int lastColumn = right / kMarkSide, lastRow = high / kMarkSide;
  for (int y = low / kBlocks; y <= lastRow / kBlocks; ++y) {
    for (int x = left / kBlocks; x <= lastColumn / kBlocks; ++x) {
      each(static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x),
           blockBits(std::max(left - x * kBlocks, 0), std::min(lastColumn - x * kBlocks, kBlocks - 1),
                     std::max(low - y * kBlocks, 0), std::min(lastRow - y * kBlocks, kBlocks - 1)));
    }
  }
}

bool TexelMarks::any(int x0, int y0, int x1, int y1) const {
  bool found = false;
  forEachSquare(x0, y0, x1, y1,
                [&](std::size_t square, std::uint64_t bits) { found = found || (squares_[square] & bits) != 0; });
  return found;
}

bool TexelMarks::any() const {
  return std::any_of(squares_.begin(), squares_.end(), [](std::uint64_t square) { return square != 0; });
}

std::size_t TexelMarks::count() const {
  return std::transform_reduce(squares_.begin(), squares_.end(), std::size_t{0}, std::plus<>(),
                               [](std::uint64_t square) { return static_cast<std::size_t>(std::popcount(square)); });
}

void TexelMarks::markInSquares(int x0, int y0, int x1, int y1) {
  forEachSquare(x0, y0, x1, y1, [&](std::size_t square, std::uint64_t bits) { add(square, bits); });
}

void TexelMarks::markAll() {
  markInSquares(0, 0, width_ - 1, height_ - 1);
}

void TexelMarks::add(const TexelMarks& other) {
  std::transform(squares_.begin(), squares_.end(), other.squares_.begin(), squares_.begin(),
                 [](std::uint64_t own, std::uint64_t more) { return own | more; });
}

TexelMarks TexelMarks::grown(int x, int y) const {
  TexelMarks more(width_, height_);
  const auto add = [&](int x0, int y0, int side) { more.mark(x0 - x, y0 - y, x0 + side - 1 + x, y0 + side - 1 + y); };
  for (std::size_t i = 0; i < squares_.size(); ++i) {
    const int x0 = static_cast<int>(i) % across_ * kMarkSquare, y0 = static_cast<int>(i) / across_ * kMarkSquare;
    std::uint64_t left = squares_[i];
    if (left == ~std::uint64_t{0}) {
      add(x0, y0, kMarkSquare);
      continue;
    }
    for (; left != 0; left &= left - 1) {
      const int block = std::countr_zero(left);
      add(x0 + block % 8 * kMarkSide, y0 + block / 8 * kMarkSide, kMarkSide);
    }
  }
  return more;
}

TexelMarks TexelMarks::without(const TexelMarks& other) const {
  TexelMarks left = *this;
  std::transform(squares_.begin(), squares_.end(), other.squares_.begin(), left.squares_.begin(),
                 [](std::uint64_t own, std::uint64_t less) { return own & ~less; });
  return left;
}

} // namespace gnomon::cpu
