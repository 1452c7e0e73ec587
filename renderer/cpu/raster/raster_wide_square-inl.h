// A wide triangle in one square of the picture. Sides that the whole square lies within count no more; the values of
// the others are small there.
#if defined(GNOMON_CPU_RASTER_WIDE_SQUARE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_WIDE_SQUARE_INL_H
#undef GNOMON_CPU_RASTER_WIDE_SQUARE_INL_H
#else
#define GNOMON_CPU_RASTER_WIDE_SQUARE_INL_H
#endif

#include "renderer/cpu/raster/raster_square-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// A side that crosses the square: as SmallField's, but sample s of the pixel (x, y) from the square's lower left one
/// has the value first[s] + a x + b y, which must not be negative.
template <int samples>
struct CrossingSide {
  std::int32_t a, b;
  std::int32_t first[samples];
  std::int32_t greatest; ///< of a block's samples, besides a x + b y of its lower left pixel
  std::int32_t least;
  Int within;
};

/// Sides that cross a square; none where the triangle has nothing there.
template <int samples>
struct CrossingSides {
  CrossingSide<samples> sides[3];
  int count;
  bool touched;
};

template <int samples>
HWY_INLINE CrossingSides<samples> sidesIn(const Square& square, const std::array<glm::ivec2, 3>& corners) {
  CrossingSides<samples> crossing;
  crossing.count = 0;
  crossing.touched = true;
  const Int x = laneNumbers() & Int(kBlockSide - 1), y = shiftRight<2>(laneNumbers());
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::ivec2 from = corners[i], to = corners[(i + 1) % 3];
    const std::int64_t a = std::int64_t{from.y} - to.y, b = std::int64_t{to.x} - from.x;
    const bool owns = a > 0 || (a == 0 && b < 0);
    std::int64_t first[samples];
    for (std::size_t s = 0; s < samples; ++s) {
      const glm::ivec2 place =
          glm::ivec2(square.blocks.x0, square.blocks.y0) * (kBlockSide * kSubpixels) + kSamplePlaces<samples>[s];
      first[s] = (a * (place.x - from.x) + b * (place.y - from.y) - (owns ? 0 : 1)) >> 8;
    }
    const auto [low, high] = std::minmax_element(first, first + samples);
    const std::int64_t up = std::max<std::int64_t>(a, 0) + std::max<std::int64_t>(b, 0);
    const std::int64_t down = std::min<std::int64_t>(a, 0) + std::min<std::int64_t>(b, 0);
    crossing.touched = crossing.touched && *high + (kSquareSide - 1) * up >= 0;
    if (*low + (kSquareSide - 1) * down >= 0) continue;
    if (!crossing.touched) break;
    // It changes its sign within the square, so that no value is greater than its change across it.
    static_assert(2 * kGuard * kSubpixels * 2 * kSquareSide <= 1 << 30);
    CrossingSide<samples>& side = crossing.sides[crossing.count++];
    side.a = static_cast<std::int32_t>(a);
    side.b = static_cast<std::int32_t>(b);
    for (std::size_t s = 0; s < samples; ++s) side.first[s] = static_cast<std::int32_t>(first[s]);
    side.greatest = static_cast<std::int32_t>(*high + (kBlockSide - 1) * up);
    side.least = static_cast<std::int32_t>(*low + (kBlockSide - 1) * down);
    side.within = x * Int(side.a) + y * Int(side.b);
  }
  return crossing;
}

/// Adds the samples of a wide triangle.
template <DepthRange range, int samples>
HWY_INLINE void rasterWide(const WideTriangle& triangle, const Square& square, HoledPixels<range, samples>& holed) {
  const BlockSpan span{std::max(triangle.blocks.x0, square.blocks.x0), std::max(triangle.blocks.y0, square.blocks.y0),
                       std::min(triangle.blocks.x1, square.blocks.x1), std::min(triangle.blocks.y1, square.blocks.y1)};
  if ((span.marks() & square.wanted) == 0) return;
  const CrossingSides<samples> crossing = sidesIn<samples>(square, triangle.corners);
  if (!crossing.touched) return;
  const TriangleMarks marks{triangle.number, triangle.holed, triangle.turned};
  const DepthPlane& plane = triangle.plane;
  Float depthWithin[samples];
  for (std::size_t s = 0; s < samples; ++s) {
    const glm::dvec2 place = glm::dvec2(kSamplePlaces<samples>[s]) * (1.0 / kSubpixels);
    depthWithin[s] = mulAdd(laneColumns(), static_cast<float>(plane.dx),
                            mulAdd(laneRows(), static_cast<float>(plane.dy),
                                   Float(static_cast<float>(place.x * plane.dx + place.y * plane.dy))));
  }
  for (int row = span.y0; row <= span.y1; ++row) {
    for (int column = span.x0; column <= span.x1; ++column) {
      if (!square.wants(column, row)) continue;
      const int x = (column - square.blocks.x0) * kBlockSide, y = (row - square.blocks.y0) * kBlockSide;
      std::int32_t value[3];
      bool touched = true, whole = true;
      for (int i = 0; i < crossing.count; ++i) {
        const CrossingSide<samples>& side = crossing.sides[i];
        value[i] = side.a * x + side.b * y;
        touched = touched && value[i] + side.greatest >= 0;
        whole = whole && value[i] + side.least >= 0;
      }
      if (!touched) continue;
      // In two parts, so that only their sum is rounded: what blocks had in common would show as steps.
      const double depthHere = plane.first + plane.dx * (column * kBlockSide) + plane.dy * (row * kBlockSide);
      const auto most = static_cast<float>(depthHere);
      const Float rest(static_cast<float>(depthHere - static_cast<double>(most)));
      const auto covered = [&](int s) HWY_ATTR {
        Int signs(0);
        if (!whole) {
          for (int i = 0; i < crossing.count; ++i) {
            signs = signs | (crossing.sides[i].within + Int(value[i] + crossing.sides[i].first[s]));
          }
        }
        return signs >= Int(0);
      };
      const auto depthOf = [&](int s) HWY_ATTR {
        return clamp(most + (rest + depthWithin[s]), triangle.least, triangle.most);
      };
      addToBlock<range, samples>(square, marks, column, row, covered, depthOf, holed);
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
