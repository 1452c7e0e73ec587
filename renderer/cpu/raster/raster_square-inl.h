// One square of the picture: which samples a triangle covers there, and which of them it hides.
#if defined(GNOMON_CPU_RASTER_SQUARE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_SQUARE_INL_H
#undef GNOMON_CPU_RASTER_SQUARE_INL_H
#else
#define GNOMON_CPU_RASTER_SQUARE_INL_H
#endif

#include <algorithm>
#include <bit>

#include "renderer/cpu/lanes/functions-inl.h"
#include "renderer/cpu/raster/raster_holed-inl.h"
#include "renderer/cpu/raster/raster_triangles.h"
#include "renderer/cpu/raster/raster_view.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

static_assert(kMarkSide == 2 * kBlockSide);

/// A square that is rastered.
struct Square {
  float* depths;          ///< of the whole picture
  std::uint32_t* numbers; ///< null = not asked for
  int blocksAcross;       ///< of the picture
  BlockSpan blocks;
  std::uint64_t wanted; ///< as TexelMarks has them

  HWY_INLINE bool wants(int column, int row) const {
    return (wanted >> (8 * (row >> 1 & 7) + (column >> 1 & 7)) & 1) != 0;
  }
  /// Where the block's first sample lies.
  template <int samples>
  HWY_INLINE std::size_t blockAt(int column, int row) const {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(blocksAcross) + static_cast<std::size_t>(column)) *
           (samples * kBlockPlaces);
  }
};

/// What of a triangle is kept with its samples.
struct TriangleMarks {
  std::uint32_t number;
  bool holed;
  bool turned;
};

/// Adds a triangle to a block. `covered` and `depthOf` are of the sixteen samples of each number. Holes are those of
/// pixels, and so are asked for once for all samples.
template <DepthRange range, int samples, class Covered, class Depth>
HWY_INLINE void addToBlock(const Square& square, const TriangleMarks& triangle, int column, int row,
                           const Covered& covered, const Depth& depthOf, HoledPixels<range, samples>& holed) {
  const std::size_t first = square.blockAt<samples>(column, row);
  const auto at = [&](int s) { return first + static_cast<std::size_t>(s * kBlockPlaces); };
  if (triangle.holed) {
    Float depths[samples];
    Mask asked = maskOf(0);
    for (int s = 0; s < samples; ++s) {
      const Float depth = depthOf(s);
      const Mask own = covered(s) & isNearer<range>(depth, load(square.depths + at(s)));
      asked = asked | own;
      depths[s] = select(own, depth, Float(HoledPixels<range, samples>::kBehind));
    }
    if (any(asked)) holed.add(triangle.number, triangle.turned, column, row, first, asked, depths);
    return;
  }
  // Of two at one depth the first one is shown.
  if (square.numbers != nullptr) holed.settle();
  for (int s = 0; s < samples; ++s) {
    const Float depth = depthOf(s), before = load(square.depths + at(s));
    const Mask own = covered(s) & isNearer<range>(depth, before);
    // Whole vectors are stored in less time than some of their lanes.
    store(select(own, depth, before), square.depths + at(s));
    if (square.numbers == nullptr) continue;
    std::uint32_t* const numbers = square.numbers + at(s);
    store(select(own, Int(static_cast<std::int32_t>(triangle.number)), load(numbers)), numbers);
  }
}

HWY_INLINE Float laneColumns() {
  return toFloat(laneNumbers() & Int(kBlockSide - 1));
}
HWY_INLINE Float laneRows() {
  return toFloat(shiftRight<2>(laneNumbers()));
}

/// Adds the samples of a small triangle. Its values stay below 2^23, where floats are exact.
template <DepthRange range, int samples>
HWY_INLINE void rasterSmall(const float* triangle, const Square& square, HoledPixels<range, samples>& holed) {
  const auto field = [&](int i) HWY_ATTR { return triangle[static_cast<std::size_t>(i) * SmallTriangles::kStride]; };
  const auto bits = [&](int i) HWY_ATTR { return std::bit_cast<std::uint32_t>(field(i)); };
  constexpr std::uint32_t kPlace = (1u << 14) - 1;
  const std::uint32_t first = bits(kFirstBlock), last = bits(kLastBlock);
  const int firstColumn = static_cast<int>(first & kPlace), firstRow = static_cast<int>(first >> 14);
  const BlockSpan span{std::max(firstColumn, square.blocks.x0), std::max(firstRow, square.blocks.y0),
                       std::min(static_cast<int>(last & kPlace), square.blocks.x1),
                       std::min(static_cast<int>(last >> 14 & kPlace), square.blocks.y1)};
  if ((span.marks() & square.wanted) == 0) return;
  const float a[3] = {field(kSideA0), field(kSideA1), -(field(kSideA0) + field(kSideA1))};
  const float b[3] = {field(kSideB0), field(kSideB1), -(field(kSideB0) + field(kSideB1))};
  const float depth = field(kDepth), dx = field(kDepthX), dy = field(kDepthY);
  const Float leastDepth = field(kLeastDepth), mostDepth = field(kMostDepth);
  const TriangleMarks marks{bits(kNumber), (last & kHoled) != 0, (last & kTurned) != 0};
  const Float x = laneColumns(), y = laneRows();
  Float within[3], least[3 * samples], depthWithin[samples];
  for (int i = 0; i < 3; ++i) within[i] = mulAdd(x, a[i], y * b[i]);
  for (int i = 0; i < 3 * samples; ++i) least[i] = field(kLeastValues + i);
  constexpr auto& places = kSamplePlaces<samples>;
  for (int s = 0; s < samples; ++s) {
    constexpr float kPixel = 1.0f / kSubpixels;
    const glm::vec2 place = glm::vec2(places[static_cast<std::size_t>(s)] - places[0]) * kPixel;
    depthWithin[s] = mulAdd(x, dx, mulAdd(y, dy, Float(place.x * dx + place.y * dy)));
  }
  for (int row = span.y0; row <= span.y1; ++row) {
    const auto up = static_cast<float>(kBlockSide * (row - firstRow));
    for (int column = span.x0; column <= span.x1; ++column) {
      if (!square.wants(column, row)) continue;
      const auto across = static_cast<float>(kBlockSide * (column - firstColumn));
      Float value[3];
      for (int i = 0; i < 3; ++i) value[i] = within[i] + Float(a[i] * across + b[i] * up);
      const Float depthHere(depth + (dx * across + dy * up));
      const auto covered = [&](int s) HWY_ATTR {
        return (value[0] >= least[s]) & (value[1] >= least[samples + s]) & (value[2] >= least[2 * samples + s]);
      };
      const auto depthOf = [&](int s) HWY_ATTR { return clamp(depthHere + depthWithin[s], leastDepth, mostDepth); };
      addToBlock<range, samples>(square, marks, column, row, covered, depthOf, holed);
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
