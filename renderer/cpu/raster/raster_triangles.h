#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/raster/texel_marks.h"

namespace gnomon::cpu {

/// Corners of small triangles lie less than this apart, in 1/256 of a pixel: what finds their samples fits 24 bits.
inline constexpr std::int32_t kSmallSide = 1 << 14;

/// What a small triangle is rastered by, a float each or the bits of an integer. Its corners go round
/// counter-clockwise. Sides: at sample s of the pixel (x, y) from the lower left one of its first block, a x + b y has
/// to reach the least value of side and sample. A value stands for the floor of the edge function over 256, from which
/// steps of whole pixels, 256 a and 256 b, lose nothing. (Pineda, "A Parallel Algorithm for Polygon Rasterization",
/// 1988.)
enum SmallField {
  kSideA0, ///< of side 0, from corner 0 to corner 1, in 1/256 of a pixel; the three sides' sum is 0
  kSideB0,
  kSideA1,
  kSideB1,
  kDepth,  ///< at sample 0 of the first block's lower left pixel
  kDepthX, ///< its change by a pixel
  kDepthY,
  kLeastDepth, ///< of the corners
  kMostDepth,
  kFirstBlock, ///< integer: column | row << 14 of the lower left block that it may touch
  kLastBlock,  ///< integer: the same of the upper right one; and kHoled, kTurned
  kNumber,     ///< integer
  kLeastValues ///< of each side, all its samples
};
inline constexpr std::uint32_t kHoled = 1u << 28;
inline constexpr std::uint32_t kTurned = 1u << 29; ///< as its scene has them, its corners go round clockwise

/// Small triangles, in chunks: of some of them each field in a row.
class SmallTriangles {
 public:
  /// From a field to the next one. A chunk takes a few triangles less than it has room for.
  static constexpr std::size_t kStride = 256 + 16;

  void clear(int samples) {
    chunkValues_ = (kLeastValues + 3 * static_cast<std::size_t>(samples)) * kStride;
    chunk_ = count_ = 0;
  }
  /// Where the fields of the next triangle go, with room for sixteen.
  std::size_t end() {
    if (count_ + 16 > kStride) {
      chunk_ += chunkValues_;
      count_ = 0;
    }
    if (values_.size() < chunk_ + chunkValues_) values_.resize(chunk_ + chunkValues_);
    return chunk_ + count_;
  }
  void add(std::size_t triangles) { count_ += triangles; }

  float* at(std::size_t triangle) { return values_.data() + triangle; }
  const float* at(std::size_t triangle) const { return values_.data() + triangle; }

 private:
  std::vector<float, Unfilled<float>> values_;
  std::size_t chunkValues_ = 0;
  std::size_t chunk_ = 0; ///< where the last one begins
  std::size_t count_ = 0; ///< of its triangles
};

/// Depth on the picture, in pixels from its lower left corner.
struct DepthPlane {
  double first = 0;
  double dx = 0, dy = 0;
};

/// Blocks of the picture; the last ones belong to it.
struct BlockSpan {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;

  /// Of a span within one square, as TexelMarks has them.
  std::uint64_t marks() const { return blockBits(x0 >> 1 & 7, x1 >> 1 & 7, y0 >> 1 & 7, y1 >> 1 & 7); }
};

/// One that is not small: its corners lie far apart, or almost in a line, or were made by clipping.
struct WideTriangle {
  std::array<glm::ivec2, 3> corners; ///< 1/256 of a pixel from the picture's lower left corner; counter-clockwise
  BlockSpan blocks;                  ///< that it may touch
  DepthPlane plane;
  float least = 0, most = 0; ///< depths of its corners
  std::uint32_t number = 0;
  bool holed = false;
  bool turned = false; ///< as kTurned
};

/// A triangle that may touch a square of the picture.
struct SquareTouch {
  std::uint32_t square;
  std::uint32_t entry; ///< kWideEntry and the number of a wide triangle, or where a small one lies
};
inline constexpr std::uint32_t kWideEntry = 1u << 31;

/// In the triangles' order.
class SquareTouches {
 public:
  void clear() { count_ = 0; }
  /// Where the next ones go, with room for as many.
  SquareTouch* room(std::size_t count) {
    if (values_.size() < count_ + count) values_.resize(2 * values_.size() + count);
    return values_.data() + count_;
  }
  void add(std::size_t count) { count_ += count; }
  void add(const SquareTouch& touch) {
    *room(1) = touch;
    add(std::size_t{1});
  }

  std::size_t size() const { return count_; }
  const SquareTouch* begin() const { return values_.data(); }
  const SquareTouch* end() const { return values_.data() + count_; }

 private:
  std::vector<SquareTouch, Unfilled<SquareTouch>> values_;
  std::size_t count_ = 0;
};

/// Draws that follow each other: their triangles that may cover a sample, and which of them may touch each square of
/// the picture.
struct TriangleGroup {
  SmallTriangles small;
  std::vector<WideTriangle> wide;
  SquareTouches touches;
  std::vector<std::uint32_t> firstEntry; ///< one a square, and the end
  std::vector<std::uint32_t> entries;    ///< as SquareTouch's; square by square, in the triangles' order within each
};

} // namespace gnomon::cpu
