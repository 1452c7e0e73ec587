// One square of the picture: which samples a triangle covers there, and which of them it hides.
#if defined(GNOMON_CPU_RASTER_SQUARE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_SQUARE_INL_H
#undef GNOMON_CPU_RASTER_SQUARE_INL_H
#else
#define GNOMON_CPU_RASTER_SQUARE_INL_H
#endif

#include <algorithm>

#include "renderer/cpu/lanes-inl.h"
#include "renderer/cpu/raster_view.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// A side of a triangle: at pixel (x, y) its value is first + a x + b y, and a sample is inside where that is not
/// negative. A value stands for the floor of the edge function over 256, from which steps of whole pixels, 256 a and
/// 256 b, lose nothing. (Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988.)
struct Side {
  std::int64_t first = 0;
  std::int64_t a = 0, b = 0;
};

HWY_INLINE Side sideOf(const Corner& from, const Corner& to, const glm::ivec2& sample) {
  const std::int64_t a = std::int64_t{from.y} - to.y;
  const std::int64_t b = std::int64_t{to.x} - from.x;
  // Corners go round counter-clockwise, y up: a left side goes down, an upper one to the left.
  const bool ownsSamples = a > 0 || (a == 0 && b < 0);
  const std::int64_t value = a * (sample.x - from.x) + b * (sample.y - from.y) - (ownsSamples ? 0 : 1);
  return {value >> 8, a, b};
}

/// Depth at the samples of pixels.
struct DepthPlane {
  double first = 0; ///< at pixel (0, 0)
  double dx = 0, dy = 0;
  float least = 0, most = 0; ///< of the corners
};

HWY_INLINE DepthPlane depthPlane(const RasterTriangle& triangle, const glm::ivec2& sample) {
  const auto& [p, q, r] = triangle.corners;
  const double qx = q.x - p.x, qy = q.y - p.y, rx = r.x - p.x, ry = r.y - p.y;
  const double qz = static_cast<double>(q.z) - p.z, rz = static_cast<double>(r.z) - p.z;
  const double scale = kSubpixels / (qx * ry - rx * qy);
  DepthPlane plane;
  plane.dx = (qz * ry - rz * qy) * scale;
  plane.dy = (rz * qx - qz * rx) * scale;
  plane.first = p.z + (plane.dx * (sample.x - p.x) + plane.dy * (sample.y - p.y)) / kSubpixels;
  plane.least = std::min({p.z, q.z, r.z});
  plane.most = std::max({p.z, q.z, r.z});
  return plane;
}

struct SquareSpan {
  int x0, y0, x1, y1; ///< blocks; the last ones belong to it
};

/// Adds one sample of a triangle.
template <DepthRange range>
HWY_INLINE void rasterSample(const RasterTriangle& triangle, const SquareSpan& span, int sampleIndex,
                             const glm::ivec2& sample, DepthBuffer& target, const Holes* holes) {
  const auto& c = triangle.corners;
  const Side sides[3] = {sideOf(c[0], c[1], sample), sideOf(c[1], c[2], sample), sideOf(c[2], c[0], sample)};
  const DepthPlane plane = depthPlane(triangle, sample);
  const Int lane = laneNumbers();
  const Int laneX = lane & Int(kBlockSide - 1);
  const Int laneY = shiftRight<2>(lane);
  Int within[3];
  std::int64_t most[3]; // what a block adds to its first pixel's value, at most
  for (int i = 0; i < 3; ++i) {
    within[i] = laneX * Int(static_cast<std::int32_t>(sides[i].a)) + laneY * Int(static_cast<std::int32_t>(sides[i].b));
    most[i] = (kBlockSide - 1) * (std::max<std::int64_t>(sides[i].a, 0) + std::max<std::int64_t>(sides[i].b, 0));
  }
  const Float depthWithin =
      toFloat(laneX) * static_cast<float>(plane.dx) + toFloat(laneY) * static_cast<float>(plane.dy);
  const bool numbered = !target.triangles.empty();
  // Beyond it a value's sign can't change within a block.
  constexpr std::int64_t kFar = std::int64_t{1} << 28;
  for (int row = span.y0; row <= span.y1; ++row) {
    for (int column = span.x0; column <= span.x1; ++column) {
      const std::int64_t x = column * kBlockSide, y = row * kBlockSide;
      std::int64_t value[3];
      bool outside = false;
      for (int i = 0; i < 3; ++i) {
        value[i] = sides[i].first + sides[i].a * x + sides[i].b * y;
        outside = outside || value[i] + most[i] < 0;
      }
      if (outside) continue;
      Int signs(0);
      for (int i = 0; i < 3; ++i) {
        signs = signs | (within[i] + Int(static_cast<std::int32_t>(std::clamp(value[i], -kFar, kFar))));
      }
      const double first = plane.first + plane.dx * static_cast<double>(x) + plane.dy * static_cast<double>(y);
      Float depth = clamp(depthWithin + Float(static_cast<float>(first)), plane.least, plane.most);
      if constexpr (range == DepthRange::clamped) depth = clamp(depth, 0.0f, 1.0f);
      const std::size_t at = target.blockAt(column, row, sampleIndex);
      const Float before = load(&target.depths[at]);
      Mask shows = (signs >= Int(0)) & (range == DepthRange::reversed ? depth > before : depth < before);
      if (none(shows)) continue;
      if (triangle.holed) {
        shows = maskOf(holes->filled(triangle.number, !triangle.turned, column, row, sampleIndex, bitsOf(shows)));
      }
      store(select(shows, depth, before), &target.depths[at]);
      if (!numbered) continue;
      const Int number(static_cast<std::int32_t>(triangle.number));
      store(select(shows, number, load(&target.triangles[at])), &target.triangles[at]);
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
