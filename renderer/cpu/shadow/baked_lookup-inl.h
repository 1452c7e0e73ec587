// The share of a light that its light map holds for sixteen places of triangles.
#if defined(GNOMON_CPU_BAKED_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_BAKED_LOOKUP_INL_H
#undef GNOMON_CPU_BAKED_LOOKUP_INL_H
#else
#define GNOMON_CPU_BAKED_LOOKUP_INL_H
#endif

#include <bit>

#include "renderer/bake/light_map.h"
#include "renderer/cpu/lanes/gather-inl.h"
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

/// `number`: of triangles of the map, in all lanes.
HWY_INLINE MapTriangle mapTriangles(const BakedMap& map, const Int& number) {
  const auto* numbers = &map.corners->x;
  const Int at = number * Int(6);
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

/// A line of sight may miss a triangle that is seen edge-on: the map is asked for the triangle all the same.
HWY_INLINE Float shareIn(const BakedMap& map, const MapTriangle& triangle, const Float2& weights, const Mask& asked) {
  const Float u = clamp(weights.x, 0.0f, 1.0f);
  const Float v = clamp(weights.y, 0.0f, 1.0f - u);
  return shareAt(map, triangle.corner + triangle.edge1 * u + triangle.edge2 * v, asked);
}

/// Lanes outside of `asked` hold anything in 0 to 1.
inline Float bakedValue(const BakedMap& map, const Receiver& receiver, const Mask& asked) {
  static_assert(kClusterTriangles == 1 << 10);
  if (none(asked)) return 1.0f;
  alignas(64) std::int32_t triangles[kLanes];
  store(receiver.triangle, triangles);
  const std::int32_t first = triangles[std::countr_zero(bitsOf(asked))];
  const Int triangle = select(asked, receiver.triangle, Int(first));
  if (all(triangle == Int(first))) {
    const std::size_t number = map.numberOf(static_cast<std::uint32_t>(first));
    const std::uint16_t even = map.evenTriangles[number];
    if (even != EvenBlocks::kUneven) return Float(static_cast<float>(even) * (1.0f / 65535.0f));
    const glm::vec2* at = map.corners + 3 * number;
    return shareIn(map, mapTriangleOf(Float2(at[0]), Float2(at[1]), Float2(at[2])), receiver.weights, asked);
  }
  const Int number = gather(map.firstTriangles.data(), shiftRightUnsigned<10>(triangle)) + (triangle & Int(1023));
  const Int even = gatherPairs(map.evenTriangles, number) & Int(0xffff);
  if (none(even == Int(EvenBlocks::kUneven))) return toFloat(even) * (1.0f / 65535.0f);
  return shareIn(map, mapTriangles(map, number), receiver.weights, asked);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
