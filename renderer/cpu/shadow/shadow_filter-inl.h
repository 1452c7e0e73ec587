// Comparisons with a tile's depths: shaders/common_shadow_filter.glsl, sixteen at a time. The receiver's plane is
// compared with each texel at that texel's place, so that a surface does not shadow itself however wide the kernel.
#if defined(GNOMON_CPU_SHADOW_FILTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_FILTER_INL_H
#undef GNOMON_CPU_SHADOW_FILTER_INL_H
#else
#define GNOMON_CPU_SHADOW_FILTER_INL_H
#endif

#include "renderer/cpu/shadow/shadow_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The depths of the receivers' planes.
struct PlaneDepths {
  Float depth;  ///< at the place that is looked up
  Float2 slope; ///< with each texel
};

/// Where nothing is drawn a map's depth is 1.
HWY_INLINE Mask isLit(const Float& plane, const Float& depth) {
  return depth >= min(plane, 1.0f);
}

/// Weights of the texels along an axis of a kernel of 3, 5 or 7 bilinear comparisons, each the next one's neighbour: as
/// many comparisons as `size`, one texel more; 0 around them.
template <int size>
inline constexpr float kKernel[size + 2] = {};
template <>
inline constexpr float kKernel<1>[3] = {0, 1, 0};
template <>
inline constexpr float kKernel<3>[5] = {0, 1, 2, 1, 0};
template <>
inline constexpr float kKernel<5>[7] = {0, 1, 3, 4, 3, 1, 0};
template <>
inline constexpr float kKernel<7>[9] = {0, 1, 5, 12, 16, 12, 5, 1, 0};

template <int size>
constexpr float kernelSum() {
  float sum = 0;
  for (const float weight : kKernel<size>) sum += weight;
  return sum;
}

/// Bilinear comparisons of a map of one sample a texel. `place`: in texels of the tile.
template <int size>
inline Float kernelVisibility(const TileMap& map, const Float2& place, const PlaneDepths& plane) {
  const Float2 base(floor(place.x - 0.5f), floor(place.y - 0.5f));
  const Float2 fraction(place.x - 0.5f - base.x, place.y - 0.5f - base.y);
  const Int firstX = truncated(base.x) - Int(size / 2);
  const Int firstY = truncated(base.y) - Int(size / 2);
  Int columns[size + 1];
  Float weights[size + 1];
  for (int x = 0; x <= size; ++x) {
    columns[x] = columnIndex(map, firstX + Int(x));
    weights[x] = mix(kKernel<size>[x + 1], kKernel<size>[x], fraction.x);
  }
  const Float2 toFirst(-fraction.x - static_cast<float>(size / 2), -fraction.y - static_cast<float>(size / 2));
  Float rowDepth = plane.depth + dot(plane.slope, toFirst);
  Float sum = 0.0f;
  for (int y = 0; y <= size; ++y) {
    const Int row = rowIndex(map, firstY + Int(y));
    Float depth = rowDepth;
    Float rowSum = 0.0f;
    for (int x = 0; x <= size; ++x) {
      rowSum += select(isLit(depth, depthAt(map, columns[x] + row)), weights[x], 0.0f);
      depth += plane.slope.x;
    }
    sum = mulAdd(mix(kKernel<size>[y + 1], kKernel<size>[y], fraction.y), rowSum, sum);
    rowDepth += plane.slope.y;
  }
  constexpr float total = kernelSum<size>();
  return sum * (1.0f / (total * total));
}

/// The same of a map of several samples a texel: the share of a square's samples that are no nearer to the light than
/// the plane. A sample may lie half a texel off the centre, and a texel beside the place weighs as one under it.
inline Float samplesVisibility(const TileMap& map, const Float2& place, const PlaneDepths& plane, int size) {
  const Int middleX = truncated(place.x);
  const Int middleY = truncated(place.y);
  const Float nearest = plane.depth - 0.5f * (abs(plane.slope.x) + abs(plane.slope.y));
  const int reach = size / 2;
  const int samples = map.depths->samples;
  Float sum = 0.0f;
  for (int y = -reach; y <= reach; ++y) {
    const Int row = rowIndex(map, middleY + Int(y));
    const Float offsetY = toFloat(middleY) + (static_cast<float>(y) + 0.5f) - place.y;
    for (int x = -reach; x <= reach; ++x) {
      const Int index = columnIndex(map, middleX + Int(x)) + row;
      const Float offsetX = toFloat(middleX) + (static_cast<float>(x) + 0.5f) - place.x;
      const Float depth = nearest + dot(plane.slope, Float2(offsetX, offsetY));
      for (int i = 0; i < samples; ++i) sum += select(isLit(depth, depthAt(map, index, i)), Float(1.0f), 0.0f);
    }
  }
  return sum / static_cast<float>(size * size * samples);
}

/// `size`: 1, 3, 5 or 7 texels.
inline Float squareVisibility(const TileMap& map, const Float2& place, const PlaneDepths& plane, int size) {
  if (map.depths->samples > 1) return samplesVisibility(map, place, plane, size);
  if (size <= 1) return kernelVisibility<1>(map, place, plane);
  if (size == 3) return kernelVisibility<3>(map, place, plane);
  if (size == 5) return kernelVisibility<5>(map, place, plane);
  return kernelVisibility<7>(map, place, plane);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
