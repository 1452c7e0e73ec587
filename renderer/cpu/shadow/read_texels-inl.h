// Which texels the lookups of shadow_visibility-inl.h read: never fewer, a few more.
#if defined(GNOMON_CPU_READ_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_READ_TEXELS_INL_H
#undef GNOMON_CPU_READ_TEXELS_INL_H
#else
#define GNOMON_CPU_READ_TEXELS_INL_H
#endif

#include <span>

#include "renderer/cpu/raster/texel_marks.h"
#include "renderer/cpu/shadow/shadow_visibility-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Texels around places.
struct Reached {
  Int left, right, low, high;
};

HWY_INLINE Reached reachedAround(const Float2& place, const Float2& reach) {
  return {truncated(floor(place.x - reach.x)), truncated(floor(place.x + reach.x)), truncated(floor(place.y - reach.y)),
          truncated(floor(place.y + reach.y))};
}

/// Marks the texels as far as `reach` around the places of the lanes `where`, of which there are some.
inline void markAround(const Float2& place, const Float2& reach, const Mask& where, TexelMarks& marks) {
  const auto [left, right, low, high] = reachedAround(place, reach);
  const std::int32_t x0 = leastOf(where, left), x1 = mostOf(where, right);
  const std::int32_t y0 = leastOf(where, low), y1 = mostOf(where, high);
  // Neighbours mostly read the same blocks.
  constexpr std::int32_t kTogether = 2 * kMarkSide;
  if (x1 - x0 < kTogether && y1 - y0 < kTogether) {
    marks.mark(x0, y0, x1, y1);
    return;
  }
  alignas(64) std::int32_t corners[4][kLanes];
  store(left, corners[0]);
  store(low, corners[1]);
  store(right, corners[2]);
  store(high, corners[3]);
  for (unsigned lanes = bitsOf(where); lanes != 0; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    marks.mark(corners[0][lane], corners[1][lane], corners[2][lane], corners[3][lane]);
  }
}

/// Marks what mapVisibility reads for the receivers. `marks`: one a tile of the maps.
inline void markMapReads(const ShadowMaps& maps, const LightData& light, const Receiver& shown,
                         const Float3& shownToLight, std::span<TexelMarks> marks) {
  if (light.tileCount == 0u) return;
  const auto [receiver, toLight] = shadedReceiver(light, shown, shownToLight);
  const MapReads reads = mapReads(maps, light, receiver, toLight, receiver.shown);
  for (int i = 0; i < static_cast<int>(light.tileCount) && any(reads.asked); ++i) {
    const int tileIndex = static_cast<int>(light.firstTile) + i;
    const TileMap& map = maps.maps[tileIndex];
    if (map.depths == nullptr || none(reads.of(i))) continue;
    const TileData& tile = maps.tiles[tileIndex];
    const Lookup at = lookupIn(light, tile, receiver, toLight);
    const Mask read = reads.of(i) & at.inside;
    if (none(read)) continue;
    markAround(placeIn(maps, map, at), filterReach(maps, light, tile, at), read, marks[tileIndex]);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
