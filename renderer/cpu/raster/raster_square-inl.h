// One square of the picture: which samples a triangle covers there, and which of them it hides.
#if defined(GNOMON_CPU_RASTER_SQUARE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_SQUARE_INL_H
#undef GNOMON_CPU_RASTER_SQUARE_INL_H
#else
#define GNOMON_CPU_RASTER_SQUARE_INL_H
#endif

#include <algorithm>

#include "renderer/cpu/lanes/lanes-inl.h"
#include "renderer/cpu/raster/raster_view.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// A side of a triangle: at sample s of pixel (x, y) its value is first[s] + a x + b y, and the sample is inside where
/// that is not negative. A value stands for the floor of the edge function over 256, from which steps of whole pixels,
/// 256 a and 256 b, lose nothing. (Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988.)
template <int samples>
struct Side {
  std::int64_t a = 0, b = 0;
  std::int64_t first[samples] = {};
  std::int64_t greatest = 0; ///< of a block's samples, besides a x + b y of its first pixel
  std::int64_t least = 0;
};

template <int samples>
HWY_INLINE Side<samples> sideOf(const Corner& from, const Corner& to, const glm::ivec2* places) {
  Side<samples> side;
  side.a = std::int64_t{from.y} - to.y;
  side.b = std::int64_t{to.x} - from.x;
  // Corners go round counter-clockwise, y up: a left side goes down, an upper one to the left.
  const bool ownsSamples = side.a > 0 || (side.a == 0 && side.b < 0);
  for (int s = 0; s < samples; ++s) {
    const std::int64_t value = side.a * (places[s].x - from.x) + side.b * (places[s].y - from.y);
    side.first[s] = (value - (ownsSamples ? 0 : 1)) >> 8;
  }
  const auto [low, high] = std::minmax_element(side.first, side.first + samples);
  constexpr std::int64_t kSteps = kBlockSide - 1;
  side.greatest = *high + kSteps * (std::max<std::int64_t>(side.a, 0) + std::max<std::int64_t>(side.b, 0));
  side.least = *low + kSteps * (std::min<std::int64_t>(side.a, 0) + std::min<std::int64_t>(side.b, 0));
  return side;
}

/// Depth on the picture, in pixels from its lower left corner.
struct DepthPlane {
  double first = 0;
  double dx = 0, dy = 0;
  float least = 0, most = 0; ///< of the corners
};

HWY_INLINE DepthPlane depthPlane(const RasterTriangle& triangle) {
  const auto& [p, q, r] = triangle.corners;
  const double qx = q.x - p.x, qy = q.y - p.y, rx = r.x - p.x, ry = r.y - p.y;
  const double qz = static_cast<double>(q.z) - p.z, rz = static_cast<double>(r.z) - p.z;
  const double scale = kSubpixels / (qx * ry - rx * qy);
  DepthPlane plane;
  plane.dx = (qz * ry - rz * qy) * scale;
  plane.dy = (rz * qx - qz * rx) * scale;
  plane.first = p.z - (plane.dx * p.x + plane.dy * p.y) / kSubpixels;
  plane.least = std::min({p.z, q.z, r.z});
  plane.most = std::max({p.z, q.z, r.z});
  return plane;
}

struct SquareSpan {
  int x0, y0, x1, y1; ///< blocks; the last ones belong to it

  /// As TexelMarks has them.
  HWY_INLINE std::uint64_t marks() const { return blockBits(x0 >> 1 & 7, x1 >> 1 & 7, y0 >> 1 & 7, y1 >> 1 & 7); }
};
static_assert(kMarkSide == 2 * kBlockSide);

/// Adds the samples of a triangle in a span of blocks, of those that are `wanted`: see TexelMarks.
template <DepthRange range, int samples>
HWY_INLINE void rasterTriangle(const RasterTriangle& triangle, const SquareSpan& span, std::uint64_t wanted,
                               DepthBuffer& target, const Holes* holes) {
  const glm::ivec2* places = samplePlaces(samples).data();
  const auto& c = triangle.corners;
  const Side<samples> sides[3] = {sideOf<samples>(c[0], c[1], places), sideOf<samples>(c[1], c[2], places),
                                  sideOf<samples>(c[2], c[0], places)};
  const DepthPlane plane = depthPlane(triangle);
  const Int laneX = laneNumbers() & Int(kBlockSide - 1);
  const Int laneY = shiftRight<2>(laneNumbers());
  Int within[3];
  for (int i = 0; i < 3; ++i) {
    within[i] = laneX * Int(static_cast<std::int32_t>(sides[i].a)) + laneY * Int(static_cast<std::int32_t>(sides[i].b));
  }
  const Float depthWithin =
      toFloat(laneX) * static_cast<float>(plane.dx) + toFloat(laneY) * static_cast<float>(plane.dy);
  double depthFirst[samples];
  for (int s = 0; s < samples; ++s) {
    depthFirst[s] = plane.first + (plane.dx * places[s].x + plane.dy * places[s].y) / kSubpixels;
  }
  float* const depths = target.depths.data();
  std::uint32_t* const numbers = target.triangles.empty() ? nullptr : target.triangles.data();
  // Beyond it a value's sign can't change within a block.
  constexpr std::int64_t kFar = std::int64_t{1} << 28;
  for (int row = span.y0; row <= span.y1; ++row) {
    const auto wantedHere = static_cast<unsigned>(wanted >> 8 * (row >> 1 & 7));
    for (int column = span.x0; column <= span.x1; ++column) {
      if ((wantedHere >> (column >> 1 & 7) & 1u) == 0) continue;
      const std::int64_t x = column * kBlockSide, y = row * kBlockSide;
      std::int64_t value[3];
      bool touched = true;
      bool covered = true;
      for (int i = 0; i < 3; ++i) {
        value[i] = sides[i].a * x + sides[i].b * y;
        touched = touched && value[i] + sides[i].greatest >= 0;
        covered = covered && value[i] + sides[i].least >= 0;
      }
      if (!touched) continue;
      const double depthAt = plane.dx * static_cast<double>(x) + plane.dy * static_cast<double>(y);
      for (int s = 0; s < samples; ++s) {
        Float depth = clamp(depthWithin + Float(static_cast<float>(depthFirst[s] + depthAt)), plane.least, plane.most);
        if constexpr (range == DepthRange::clamped) depth = clamp(depth, 0.0f, 1.0f);
        const std::size_t at = target.blockAt(column, row, s);
        const Float before = load(depths + at);
        Mask shows = range == DepthRange::reversed ? depth > before : depth < before;
        if (!covered) {
          Int signs(0);
          for (int i = 0; i < 3; ++i) {
            const std::int64_t first = std::clamp(value[i] + sides[i].first[s], -kFar, kFar);
            signs = signs | (within[i] + Int(static_cast<std::int32_t>(first)));
          }
          shows = shows & (signs >= Int(0));
        }
        if (none(shows)) continue;
        if (triangle.holed) {
          shows = maskOf(holes->filled(triangle.number, !triangle.turned, column, row, s, bitsOf(shows)));
        }
        store(select(shows, depth, before), depths + at);
        if (numbers == nullptr) continue;
        const Int number(static_cast<std::int32_t>(triangle.number));
        store(select(shows, number, load(numbers + at)), numbers + at);
      }
    }
  }
}

/// The blocks of a square that a triangle may touch.
HWY_INLINE SquareSpan spanIn(const RasterView& view, const RasterTriangle& triangle, int squareX, int squareY) {
  const auto& c = triangle.corners;
  const auto blocks = [&](std::int32_t least, std::int32_t most, int firstSample, int lastSample, int size, int square)
                          HWY_ATTR {
                            const PixelSpan pixels = pixelsWithin(least, most, firstSample, lastSample, size);
                            return PixelSpan{std::max(pixels.first, square * kSquareSide) / kBlockSide,
                                             std::min(pixels.last, (square + 1) * kSquareSide - 1) / kBlockSide};
                          };
  const PixelSpan across = blocks(std::min({c[0].x, c[1].x, c[2].x}), std::max({c[0].x, c[1].x, c[2].x}),
                                  view.firstSample.x, view.lastSample.x, view.width, squareX);
  const PixelSpan up = blocks(std::min({c[0].y, c[1].y, c[2].y}), std::max({c[0].y, c[1].y, c[2].y}),
                              view.firstSample.y, view.lastSample.y, view.height, squareY);
  return {across.first, up.first, across.last, up.last};
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
