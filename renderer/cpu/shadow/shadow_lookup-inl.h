// Where a receiver lies in a light's tiles: shaders/common_shadow_lookup.glsl, sixteen at a time.
#if defined(GNOMON_CPU_SHADOW_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_LOOKUP_INL_H
#undef GNOMON_CPU_SHADOW_LOOKUP_INL_H
#else
#define GNOMON_CPU_SHADOW_LOOKUP_INL_H
#endif

#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/cpu/surface/fragments-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

using shared::LightData;
using shared::TileData;

/// Where in the atlas receivers are looked up in one tile.
struct Lookup {
  Float3 coordinate; ///< atlas u v, depth less its bias
  Float divisor;     ///< metres from the light along the tile's axis; 1 for parallel light
  Mask inside;       ///< of what the tile covers; outside everything is lit
};

/// A row of an affine matrix times a point.
HWY_INLINE Float along(const glm::vec4& row, const Float3& p) {
  return mulAdd(p.x, row.x, mulAdd(p.y, row.y, mulAdd(p.z, row.z, row.w)));
}

HWY_INLINE Float along(const glm::vec3& way, const Float3& v) {
  return mulAdd(v.x, way.x, mulAdd(v.y, way.y, v.z * way.z));
}

/// The same for all of a tile.
inline bool isParallel(const TileData& tile) {
  return glm::dot(glm::vec3(tile.atlasFromRelative[3]), tile.axis) == 0.0f;
}

/// The receivers, moved so that their surface doesn't shadow itself: automatically along its normal by
/// reach * sin(angle), or as the light's own bias says.
HWY_INLINE Float3 movedReceiver(const LightData& light, const TileData& tile, const Receiver& receiver,
                                const Float3& toLight) {
  if (light.hasManualBias != 0u) {
    const Float cosine = clamp(dot(receiver.normal, toLight), 1e-2f, 1.0f);
    const Float tangent = sqrt(1.0f - cosine * cosine) / cosine;
    return receiver.relative + receiver.normal * light.manualNormalOffset +
           toLight * (light.manualDepthBias + light.manualSlopeBias * tangent);
  }
  const Float cosine = along(tile.axis, receiver.normal);
  Float offset = tile.normalOffset * sqrt(max(1.0f - cosine * cosine, 0.0f));
  if (!isParallel(tile)) offset *= along(tile.atlasFromRelative[3], receiver.relative);
  return receiver.relative + receiver.normal * offset;
}

/// Where no bias has moved them: atlas u v and depth, times the divisor.
HWY_INLINE Float3 projected(const TileData& tile, const Float3& p) {
  return {along(tile.atlasFromRelative[0], p), along(tile.atlasFromRelative[1], p),
          along(tile.atlasFromRelative[2], p)};
}

HWY_INLINE Mask isWithin(const Float3& coordinate, const TileData& tile) {
  return (coordinate.x >= tile.lowest.x) & (coordinate.y >= tile.lowest.y) & (coordinate.x <= tile.highest.x) &
         (coordinate.y <= tile.highest.y);
}

/// Tiles have room for what is in view, not for how far it is lifted: what leaves one so is looked up at its rim, and
/// just behind the casters that are drawn with their depth clamped.
HWY_INLINE void keepLifted(const Mask& lifted, const TileData& tile, Float3& coordinate) {
  if (none(lifted)) return;
  coordinate.x = select(lifted, clamp(coordinate.x, tile.lowest.x, tile.highest.x), coordinate.x);
  coordinate.y = select(lifted, clamp(coordinate.y, tile.lowest.y, tile.highest.y), coordinate.y);
  coordinate.z = select(lifted, max(coordinate.z, 1e-6f), coordinate.z);
}

HWY_INLINE Lookup lookupIn(const LightData& light, const TileData& tile, const Receiver& receiver,
                           const Float3& toLight) {
  const Float3 p = movedReceiver(light, tile, receiver, toLight);
  Lookup at;
  at.coordinate = projected(tile, p);
  if (isParallel(tile)) {
    at.divisor = 1.0f;
    at.coordinate.z -= tile.depthBias + tile.depthBiasNear;
    keepLifted(receiver.smooth.lifted, tile, at.coordinate);
    at.inside = isWithin(at.coordinate, tile);
    return at;
  }
  const Float divisor = along(tile.atlasFromRelative[3], p);
  const Mask before = divisor > 0.0f;
  at.divisor = select(before, divisor, 1.0f);
  at.coordinate = at.coordinate / at.divisor;
  at.coordinate.z -= tile.depthBias + tile.depthBiasNear / (at.divisor * at.divisor);
  keepLifted(receiver.smooth.lifted, tile, at.coordinate);
  at.inside = before & isWithin(at.coordinate, tile);
  return at;
}

/// Texels of the tile.
HWY_INLINE Float2 placeIn(const ShadowMaps& maps, const TileMap& map, const Lookup& at) {
  const Float2 corner(static_cast<float>(map.rect.x), static_cast<float>(map.rect.y));
  return Float2(at.coordinate.x, at.coordinate.y) * Float2(maps.atlasTexels) - corner;
}

/// How the tile's depth changes on the receivers' planes with each texel.
HWY_INLINE Float2 receiverSlope(const TileData& tile, const Receiver& receiver, const glm::vec3& lightPosition) {
  const Float2 across(along(tile.right, receiver.normal), along(tile.up, receiver.normal));
  if (isParallel(tile)) return across / -min(along(tile.axis, receiver.normal), -1e-4f);
  // z is a line in 1 / distance, and so is 1 / distance in the tangents of a plane.
  return across / min(dot(receiver.normal, receiver.relative - Float3(lightPosition)), -1e-6f);
}

/// The slope that comparisons follow: none where the light's own bias says all.
HWY_INLINE Float2 comparedSlope(const LightData& light, const TileData& tile, const Receiver& receiver) {
  if (light.hasManualBias != 0u) return Float2(Float(0.0f));
  return receiverSlope(tile, receiver, light.position);
}

inline constexpr float kBendAngle = 0.1f;
inline constexpr float kBendTexels = 0.3f;
inline constexpr float kNormalRounding = 2e-4f;

/// By how much a surface may rise over the receiver's plane within a texel and not shadow it, z: where it bends by up
/// to kBendAngle radians, but no more than the plane itself rises on kBendTexels; and what a normal of 16 bits an axis
/// may lean on the way to the farthest texel, `reach` away. The device of shaders keeps normals so; the same room here
/// keeps its pictures.
HWY_INLINE Float bendRoom(const LightData& light, const TileData& tile, const Lookup& at, const Float2& slope,
                          const Float& reach) {
  if (light.hasManualBias != 0u) return 0.0f;
  // With the depth that a texel's width is worth: tan(a + bend) - tan(a) is about bend (1 + tan(a)^2).
  const Float texel = tile.texelDepth / at.divisor;
  const Float bent = texel + dot(slope, slope) / max(texel, 1e-30f);
  const Float most = kBendTexels * (texel + abs(slope.x) + abs(slope.y));
  return max(min(kBendAngle * bent, most), kNormalRounding * reach * bent);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
