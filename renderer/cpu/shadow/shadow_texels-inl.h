// The texels of a tile as sixteen lanes read them: the one place that knows how they lie in memory.
#if defined(GNOMON_CPU_SHADOW_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_TEXELS_INL_H
#undef GNOMON_CPU_SHADOW_TEXELS_INL_H
#else
#define GNOMON_CPU_SHADOW_TEXELS_INL_H
#endif

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/vectors-inl.h"
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

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
