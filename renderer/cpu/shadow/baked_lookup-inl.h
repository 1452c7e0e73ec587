// The share of a light that its light map holds for sixteen places of triangles.
#if defined(GNOMON_CPU_BAKED_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_BAKED_LOOKUP_INL_H
#undef GNOMON_CPU_BAKED_LOOKUP_INL_H
#else
#define GNOMON_CPU_BAKED_LOOKUP_INL_H
#endif

#include <bit>

#include "renderer/bake/even_blocks.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/cpu/surface/fragments-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Where triangles lie in a map: a corner, and from there to the other two, texels.
struct MapTriangle {
  Float2 corner, edge1, edge2;
};

HWY_INLINE MapTriangle mapTriangleOf(const Float2& a, const Float2& b, const Float2& c) {
  return {a, b - a, c - a};
}

/// Where all lanes have one triangle, its corners are read once. REQUIRES: numbers of triangles in all lanes.
HWY_INLINE MapTriangle mapTriangles(const BakedMap& map, const Int& triangle) {
  static_assert(kClusterTriangles == 1 << 10);
  const std::int32_t number = hn::GetLane(triangle.part[0]);
  if (all(triangle == Int(number))) {
    const glm::vec2* at = map.cornersOf(static_cast<std::uint32_t>(number));
    return mapTriangleOf(Float2(at[0]), Float2(at[1]), Float2(at[2]));
  }
  const Int first = gather(map.firstCorners.data(), shiftRightUnsigned<10>(triangle)) + (triangle & Int(1023)) * Int(3);
  const auto* numbers = &map.corners->x;
  const Int at = first + first;
  const auto corner = [&](int c)
                          HWY_ATTR { return Float2(gather(numbers + 2 * c, at), gather(numbers + 2 * c + 1, at)); };
  return mapTriangleOf(corner(0), corner(1), corner(2));
}

/// Between the centres of the four texels around a place of the map, where it is `asked`.
HWY_INLINE Float shareAt(const BakedMap& map, const Float2& place, const Mask& asked) {
  const Float2 from = place - Float2(Float(0.5f));
  const Int x = min(max(truncated(from.x), Int(0)), Int(map.width - 2));
  const Int y = min(max(truncated(from.y), Int(0)), Int(map.height - 2));
  static_assert(EvenBlocks::kSide == 1 << 3);
  const Int block = shiftRightUnsigned<3>(y) * Int(map.evenColumns) + shiftRightUnsigned<3>(x);
  const Int even = gatherPairs(map.even, block) & Int(0xffff);
  if (none(asked & (even == Int(EvenBlocks::kUneven)))) return toFloat(even) * (1.0f / 65535.0f);
  const Float right = clamp(from.x - toFloat(x), 0.0f, 1.0f);
  const Float up = clamp(from.y - toFloat(y), 0.0f, 1.0f);
  const Int at = y * Int(map.width) + x;
  const auto between = [&](const Int& pair) HWY_ATTR {
    const Float left = toFloat(pair & Int(0xffff));
    return mulAdd(right, toFloat(shiftRightUnsigned<16>(pair)) - left, left);
  };
  const Float low = between(gatherPairs(map.shares, at));
  const Float high = between(gatherPairs(map.shares, at + Int(map.width)));
  return mulAdd(up, high - low, low) * (1.0f / 65535.0f);
}

/// Lanes outside of `asked` hold anything in 0 to 1. A line of sight may miss a triangle that is seen edge-on: the map
/// is asked for the triangle all the same.
inline Float bakedValue(const BakedMap& map, const Receiver& receiver, const Mask& asked) {
  if (none(asked)) return 1.0f;
  alignas(64) std::int32_t numbers[kLanes];
  store(receiver.triangle, numbers);
  const Int first(numbers[std::countr_zero(bitsOf(asked))]);
  const MapTriangle triangle = mapTriangles(map, select(asked, receiver.triangle, first));
  const Float u = clamp(receiver.weights.x, 0.0f, 1.0f);
  const Float v = clamp(receiver.weights.y, 0.0f, 1.0f - u);
  return shareAt(map, triangle.corner + triangle.edge1 * u + triangle.edge2 * v, asked);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
