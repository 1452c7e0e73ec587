// Comparisons over a disc of the world, and one as wide as the penumbra: shaders/common_shadow_disc.glsl,
// sixteen at a time.
#if defined(GNOMON_CPU_SHADOW_DISC_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_DISC_INL_H
#undef GNOMON_CPU_SHADOW_DISC_INL_H
#else
#define GNOMON_CPU_SHADOW_DISC_INL_H
#endif

#include "renderer/cpu/shadow/disc_steps.h"
#include "renderer/cpu/shadow/shadow_filter-inl.h"
#include "renderer/cpu/shadow/shadow_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Cosine and sine of noiseTurn at pixels' places.
HWY_INLINE Float2 discTurn(const Float2& place) {
  const Float angle = noiseTurn(place.x * kNoiseX + place.y * kNoiseY);
  return {cos(angle), sin(angle)};
}

/// Texels of a length across the light.
HWY_INLINE Float texelsAcross(const ShadowMaps& maps, const TileData& tile, const Float& radius) {
  return texelsAcross(tile, radius, maps.atlasTexels.x, maps.atlasTexels.y);
}

/// `radius`: a length across the light. The disc lies `height` (z) before the receivers; what of it is below their own
/// planes does not count. `asked`: lanes whose share counts.
inline Float discVisibility(const ShadowMaps& maps, int tileIndex, const Lookup& at, const Float2& slope,
                            const Float& radius, const Float& height, const Float2& pixel, const Mask& asked) {
  const shared::TileData& tile = maps.tiles[tileIndex];
  const TileMap& map = maps.maps[tileIndex];
  const Float2 texels(maps.atlasTexels);
  const Float2 corner(static_cast<float>(map.rect.x), static_cast<float>(map.rect.y));
  const Float2 turn = discTurn(pixel);
  Float sum = 0.0f;
  Float count = 0.0f;
  for (const glm::vec2& tap : discSteps()) {
    const Float2 step(radius * (turn.x * tap.x - turn.y * tap.y), radius * (turn.y * tap.x + turn.x * tap.y));
    const Float3 place(at.coordinate.x + step.x * tile.atlasPerMetre.x, at.coordinate.y + step.y * tile.atlasPerMetre.y,
                       0.0f);
    const Mask within = isWithin(place, tile);
    const Float rise = dot(slope, Float2(place.x - at.coordinate.x, place.y - at.coordinate.y) * texels);
    const Mask above = rise >= -height;
    count += select(above, Float(1.0f), 0.0f);
    const Mask read = within & above & asked;
    if (none(read)) {
      sum += select(above, Float(1.0f), 0.0f);
      continue;
    }
    const PlaneDepths plane{at.coordinate.z + rise, slope};
    const Float lit = squareVisibility(map, Float2(place.x, place.y) * texels - corner, plane, 1, read);
    sum += select(above, select(within, lit, 1.0f), 0.0f);
  }
  return sum / max(count, 1.0f);
}

HWY_INLINE float penumbraPerDepth(const ShadowMaps& maps, const LightData& light, const TileData& tile) {
  return penumbraPerDepth(light, tile, maps.atlasTexels.x);
}

/// The heights that lanes add.
struct HeightSum {
  Float sum, count;

  HWY_INLINE void add(const Mask& lanes, const Float& height) {
    sum += select(lanes, height, 0.0f);
    count += select(lanes, Float(1.0f), 0.0f);
  }
};

/// The mean z between the receivers and what stands between them and the light's disc; where the search meets no such
/// caster, of all that stand before the receivers' planes within `radius`: it may have missed one. Negative where
/// nothing does. The places are the denser the nearer: they find low casters beside high ones.
inline Float casterHeight(const ShadowMaps& maps, const LightData& light, int tileIndex, const Lookup& at,
                          const Float2& slope, const Float& radius, const Float2& turn) {
  const TileData& tile = maps.tiles[tileIndex];
  const TileMap& map = maps.maps[tileIndex];
  const Float2 texels(maps.atlasTexels);
  const Float2 corner(static_cast<float>(map.rect.x), static_cast<float>(map.rect.y));
  const Float2 middle = Float2(at.coordinate.x, at.coordinate.y) * texels - corner;
  const int samples = map.depths->samples;
  const Float lowered = samples > 1 ? halfTexelRise(slope) : Float(0.0f);
  const Float perDepth = penumbraPerDepth(maps, light, tile);
  const Float seen = seenAround(tile, maps.atlasTexels.x, maps.atlasTexels.y);
  HeightSum covering{0.0f, 0.0f};
  HeightSum standing{0.0f, 0.0f};
  int sample = 0;
  for (const glm::vec2& tap : searchSteps()) {
    const Float2 step(radius * (turn.x * tap.x - turn.y * tap.y), radius * (turn.y * tap.x + turn.x * tap.y));
    const Float3 place(at.coordinate.x + step.x * tile.atlasPerMetre.x, at.coordinate.y + step.y * tile.atlasPerMetre.y,
                       0.0f);
    const Float2 inTile = Float2(place.x, place.y) * texels - corner;
    const Int x = truncated(inTile.x);
    const Int y = truncated(inTile.y);
    const Float2 offset(toFloat(x) + 0.5f - middle.x, toFloat(y) + 0.5f - middle.y);
    const Float plane = at.coordinate.z + dot(slope, offset) - lowered;
    const Float depth = depthAt(map, columnIndex(map, x) + rowIndex(map, y), sample);
    const Float height = max(at.coordinate.z - depth, 0.0f);
    const Mask stands = andNot(isLit(plane, depth), isWithin(place, tile));
    standing.add(stands, height);
    covering.add(stands & (perDepth * height + seen >= radius * glm::length(tap)), height);
    sample = (sample + 1) % samples;
  }
  return meanHeight(covering.sum, covering.count, standing.sum, standing.count);
}

/// The radius of the penumbra at the receivers, a length across the light; negative where nothing stands before them.
inline Float penumbraRadius(const ShadowMaps& maps, const LightData& light, int tileIndex, const Lookup& at,
                            const Float2& slope, const Float2& pixel) {
  const TileData& tile = maps.tiles[tileIndex];
  const float perDepth = penumbraPerDepth(maps, light, tile);
  const Float reach = searchReach(tile, perDepth, at.coordinate.z);
  Lookup lowered = at;
  lowered.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0f + texelsAcross(maps, tile, reach));
  const Float height = casterHeight(maps, light, tileIndex, lowered, slope, reach, discTurn(pixel));
  return radiusOfHeight(perDepth, height, reach);
}

/// `asked`: lanes whose share counts.
inline Float pcssVisibility(const ShadowMaps& maps, const LightData& light, int tileIndex, const Lookup& at,
                            const Float2& slope, const Float2& pixel, const Mask& asked) {
  const Float found = penumbraRadius(maps, light, tileIndex, at, slope, pixel);
  const Mask stands = found >= 0.0f;
  if (none(stands & asked)) return 1.0f;
  const TileData& tile = maps.tiles[tileIndex];
  const Float radius = max(found, 0.0f);
  Lookup lowered = at;
  lowered.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0f + texelsAcross(maps, tile, radius));
  const Float lit = discVisibility(maps, tileIndex, lowered, slope, radius,
                                   radius / penumbraPerDepth(maps, light, tile), pixel, asked & stands);
  return select(stands, lit, 1.0f);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
