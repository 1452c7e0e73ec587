// Lookups in the blurred shadow maps: shaders/common_shadow_moments.glsl, sixteen at a time.
#if defined(GNOMON_CPU_SHADOW_MOMENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_MOMENTS_INL_H
#undef GNOMON_CPU_SHADOW_MOMENTS_INL_H
#else
#define GNOMON_CPU_SHADOW_MOMENTS_INL_H
#endif

#include "renderer/cpu/shadow/shadow_lookup-inl.h"
#include "renderer/cpu/shadow/shadow_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Bilinear between the four texels around a place, in texels of the tile.
HWY_INLINE Float blendedMoment(const TileMap& map, const Int& x, const Int& y, const Float2& fraction, int moment) {
  const Int nextX = x + Int(1);
  const Int nextY = y + Int(1);
  const Float low = mix(momentAt(map, x, y, moment), momentAt(map, nextX, y, moment), fraction.x);
  const Float high = mix(momentAt(map, x, nextY, moment), momentAt(map, nextX, nextY, moment), fraction.x);
  return mix(low, high, fraction.y);
}

inline Float momentVisibility(const TileMap& map, const Float2& place, const Float& depth, int kind) {
  const Float2 base(floor(place.x - 0.5f), floor(place.y - 0.5f));
  const Float2 fraction(place.x - 0.5f - base.x, place.y - 0.5f - base.y);
  const Int x = truncated(base.x);
  const Int y = truncated(base.y);
  Float4 moments(blendedMoment(map, x, y, fraction, 0), blendedMoment(map, x, y, fraction, 1), 0.0f, 0.0f);
  if (kind != GNOMON_FILTER_VSM) {
    moments.z = blendedMoment(map, x, y, fraction, 2);
    moments.w = blendedMoment(map, x, y, fraction, 3);
  }
  return visibilityFrom(moments, depth, kind);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
