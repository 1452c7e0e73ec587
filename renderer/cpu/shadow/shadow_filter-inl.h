// Comparisons with a tile's depths: shaders/common_shadow_filter.glsl, sixteen at a time. The receiver's plane is
// compared with each texel at that texel's place, so that a surface does not shadow itself however wide the kernel.
#if defined(GNOMON_CPU_SHADOW_FILTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_FILTER_INL_H
#undef GNOMON_CPU_SHADOW_FILTER_INL_H
#else
#define GNOMON_CPU_SHADOW_FILTER_INL_H
#endif

#include <algorithm>

#include "renderer/cpu/lanes/shared_functions-inl.h"
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

/// What some comparisons say alike.
enum class Alike { lit, dark, no };

/// Compares all texels of the box around `size` texels from each lane's first one, a block at a time: where all of them
/// are lit, or none, so is each kernel. Without a gather, that takes much less time than kernels. May say no where they
/// are alike. Those between the lanes that are not made may hold anything: what is said of the box holds for the rest.
inline Alike alikeIn(const TileMap& map, const Int& firstX, const Int& firstY, int size, const Float2& place,
                     const PlaneDepths& plane, const Mask& read) {
  const DepthBuffer& depths = *map.depths;
  const int x0 = std::max(leastOf(read, firstX), 0), x1 = std::min(mostOf(read, firstX) + size, depths.width) - 1;
  const int y0 = std::max(leastOf(read, firstY), 0), y1 = std::min(mostOf(read, firstY) + size, depths.height) - 1;
  const int left = x0 / kBlockSide * kBlockSide, bottom = y0 / kBlockSide * kBlockSide;
  constexpr int kMostBlocks = 80; // more take as long as the kernels
  if ((x1 - left + kBlockSide) / kBlockSide * ((y1 - bottom + kBlockSide) / kBlockSide) > kMostBlocks) return Alike::no;
  // From the box's first texel on, no plane lies over `high` or under `low`.
  const Float2 toFirst(static_cast<float>(left) + 0.5f - place.x, static_cast<float>(bottom) + 0.5f - place.y);
  const Float first = plane.depth + dot(plane.slope, toFirst);
  glm::vec3 low(leastOf(read, first), leastOf(read, plane.slope.x), leastOf(read, plane.slope.y));
  glm::vec3 high(mostOf(read, first), mostOf(read, plane.slope.x), mostOf(read, plane.slope.y));
  const glm::vec3 largest = glm::max(glm::abs(low), glm::abs(high));
  const glm::vec2 sides(x1 - left + 1, y1 - bottom + 1);
  const float rounding = 4e-6f * (largest.x + sides.x * largest.y + sides.y * largest.z);
  low.x -= rounding;
  high.x += rounding;
  const Float column = toFloat(laneNumbers() & Int(kBlockSide - 1)), row = toFloat(shiftRight<2>(laneNumbers()));
  const auto inBlock = [&](const glm::vec3& ends) HWY_ATTR { return ends.x + column * ends.y + row * ends.z; };
  const Float lowest = inBlock(low), highest = inBlock(high);
  bool lit = true, dark = true;
  for (int y = bottom; y <= y1; y += kBlockSide) {
    for (int x = left; x <= x1; x += kBlockSide) {
      const Float depth = load(&depths.depths[depths.blockAt(x / kBlockSide, y / kBlockSide)]);
      const glm::vec2 way(x - left, y - bottom);
      lit = lit && all(isLit(highest + glm::dot(way, glm::vec2(high.y, high.z)), depth));
      dark = dark && none(isLit(lowest + glm::dot(way, glm::vec2(low.y, low.z)), depth));
      if (!lit && !dark) return Alike::no;
    }
  }
  return lit ? Alike::lit : Alike::dark;
}

/// Bilinear comparisons of a map of one sample a texel, for the lanes `read`. `place`: in texels of the tile.
template <int size>
inline Float kernelVisibility(const TileMap& map, const Float2& place, const PlaneDepths& plane, const Mask& read) {
  const Float2 base(floor(place.x - 0.5f), floor(place.y - 0.5f));
  const Float2 fraction(place.x - 0.5f - base.x, place.y - 0.5f - base.y);
  const Int firstX = truncated(base.x) - Int(size / 2);
  const Int firstY = truncated(base.y) - Int(size / 2);
  if constexpr (size > 1) {
    const Alike alike = alikeIn(map, firstX, firstY, size + 1, place, plane, read);
    if (alike != Alike::no) return alike == Alike::lit ? 1.0f : 0.0f;
  }
  Int columns[size + 1];
  Float weights[size + 1];
  for (int x = 0; x <= size; ++x) {
    columns[x] = columnIndex(map, firstX + Int(x));
    weights[x] = mix(kKernel<size>[x + 1], kKernel<size>[x], fraction.x);
  }
  const Float2 toFirst(-fraction.x - static_cast<float>(size / 2), -fraction.y - static_cast<float>(size / 2));
  Float rowDepth = plane.depth + dot(plane.slope, toFirst);
  Float sum = 0.0f;
  Mask whole = firstLanes(kLanes); // lanes of which every texel is lit: their weights may add up to a little less
  for (int y = 0; y <= size; ++y) {
    const Int row = rowIndex(map, firstY + Int(y));
    Float depth = rowDepth;
    Float rowSum = 0.0f;
    for (int x = 0; x <= size; ++x) {
      const Mask lit = isLit(depth, depthAt(map, columns[x] + row));
      whole = whole & lit;
      rowSum += select(lit, weights[x], 0.0f);
      depth += plane.slope.x;
    }
    sum = mulAdd(mix(kKernel<size>[y + 1], kKernel<size>[y], fraction.y), rowSum, sum);
    rowDepth += plane.slope.y;
  }
  constexpr float total = kernelSum<size>();
  return select(whole, 1.0f, sum * (1.0f / (total * total)));
}

/// The same of a map of several samples a texel: the share of a square's samples that are no nearer to the light than
/// the plane. A texel beside the place weighs as one under it.
inline Float samplesVisibility(const TileMap& map, const Float2& place, const PlaneDepths& plane, int size) {
  const Int middleX = truncated(place.x);
  const Int middleY = truncated(place.y);
  const Float nearest = plane.depth - halfTexelRise(plane.slope);
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

/// `size`: 1, 3, 5 or 7 texels. Lanes outside of `read`, which has some, hold anything.
inline Float squareVisibility(const TileMap& map, const Float2& place, const PlaneDepths& plane, int size,
                              const Mask& read) {
  if (map.depths->samples > 1) return samplesVisibility(map, place, plane, size);
  if (size <= 1) return kernelVisibility<1>(map, place, plane, read);
  if (size == 3) return kernelVisibility<3>(map, place, plane, read);
  if (size == 5) return kernelVisibility<5>(map, place, plane, read);
  return kernelVisibility<7>(map, place, plane, read);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
