// The texels of a tile, and moments between them, as sixteen lanes read them: the one place that knows how they lie in
// memory.
#if defined(GNOMON_CPU_SHADOW_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_TEXELS_INL_H
#undef GNOMON_CPU_SHADOW_TEXELS_INL_H
#else
#define GNOMON_CPU_SHADOW_TEXELS_INL_H
#endif

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/shadow/shadow_maps.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

// Columns and rows count from the tile's own lowest corner. What lies beyond the tile is its outermost texel: no filter
// reads there, but lanes that are not asked for may stand anywhere.

HWY_INLINE Int keptWithin(const Int& a, int count) {
  return min(max(a, Int(0)), Int(count - 1));
}

/// A column's part of a depth's index: the index is the sum of its column's and its row's.
HWY_INLINE Int columnIndex(const TileMap& map, const Int& x) {
  const Int kept = keptWithin(x, map.depths->width);
  return shiftRight<2>(kept) * Int(kBlockPlaces * map.depths->samples) + (kept & Int(kBlockSide - 1));
}

HWY_INLINE Int rowIndex(const TileMap& map, const Int& y) {
  const Int kept = keptWithin(y, map.depths->height);
  return shiftRight<2>(kept) * Int(kBlockPlaces * map.depths->samples * map.depths->blocksAcross()) +
         shiftLeft<2>(kept & Int(kBlockSide - 1));
}

HWY_INLINE Float depthAt(const TileMap& map, const Int& index, int sample = 0) {
  return gather(map.depths->depths.data() + sample * kBlockPlaces, index);
}

/// For few texels.
HWY_INLINE Float depthAt(const TileMap& map, const Int& x, const Int& y) {
  return depthAt(map, columnIndex(map, x) + rowIndex(map, y));
}

/// One of the four moments of a texel.
HWY_INLINE Float momentAt(const TileMap& map, const Int& x, const Int& y, int moment) {
  const Int place = keptWithin(y, map.rect.height) * Int(map.rect.width) + keptWithin(x, map.rect.width);
  return gather(&map.moments.data()->x + moment, shiftLeft<2>(place));
}

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
