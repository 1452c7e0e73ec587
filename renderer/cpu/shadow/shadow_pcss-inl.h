// Percentage-closer soft shadows: shaders/common_shadow_pcss.glsl, sixteen at a time.
#if defined(GNOMON_CPU_SHADOW_PCSS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_PCSS_INL_H
#undef GNOMON_CPU_SHADOW_PCSS_INL_H
#else
#define GNOMON_CPU_SHADOW_PCSS_INL_H
#endif

#include "renderer/cpu/shadow/disc_steps.h"
#include "renderer/cpu/shadow/shadow_disc-inl.h"
#include "renderer/cpu/shadow/shadow_filter-inl.h"
#include "renderer/cpu/shadow/shadow_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The radius of the penumbra, a length across the light, for each z between caster and receiver.
inline float penumbraPerDepth(const ShadowMaps& maps, const LightData& light, const TileData& tile) {
  return light.filterRadius / (tile.texelDepth * tile.atlasPerMetre.x * maps.atlasTexels.x);
}

/// As far as the search for casters goes, a length across the light: as wide as the penumbra of the nearest one that
/// the tile can hold.
HWY_INLINE Float searchReach(const ShadowMaps& maps, const LightData& light, const TileData& tile, const Float& depth) {
  return min(penumbraPerDepth(maps, light, tile) * max(depth, 0.0f), tile.filterReach);
}

/// Texels of a length across the light.
HWY_INLINE Float texelsAcross(const ShadowMaps& maps, const TileData& tile, const Float& radius) {
  const glm::vec2 texels = tile.atlasPerMetre * maps.atlasTexels;
  return radius * std::max(texels.x, texels.y);
}

/// The mean of the heights that lanes add.
struct HeightMean {
  Float sum, count;

  HWY_INLINE void add(const Mask& lanes, const Float& height) {
    sum += select(lanes, height, 0.0f);
    count += select(lanes, Float(1.0f), 0.0f);
  }
  /// Negative where none was added.
  HWY_INLINE Float value() const { return select(count > 0.0f, sum / max(count, 1.0f), -1.0f); }
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
  // A sample may lie half a texel off the centre.
  const Float lowered = samples > 1 ? 0.5f * (abs(slope.x) + abs(slope.y)) : Float(0.0f);
  const Float perDepth = penumbraPerDepth(maps, light, tile);
  // A texel may show what stands as far off its centre, and the comparison reads as many around.
  const Float seen = 2.0f / texelsAcross(maps, tile, 1.0f);
  HeightMean covering{0.0f, 0.0f};
  HeightMean standing{0.0f, 0.0f};
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
  return select(covering.count > 0.0f, covering.value(), standing.value());
}

/// The radius of the penumbra at the receivers, a length across the light; negative where nothing stands before them.
inline Float penumbraRadius(const ShadowMaps& maps, const LightData& light, int tileIndex, const Lookup& at,
                            const Float2& slope, const Float2& pixel) {
  const TileData& tile = maps.tiles[tileIndex];
  const Float reach = searchReach(maps, light, tile, at.coordinate.z);
  Lookup lowered = at;
  lowered.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0f + texelsAcross(maps, tile, reach));
  const Float height = casterHeight(maps, light, tileIndex, lowered, slope, reach, discTurn(pixel));
  return select(height >= 0.0f, min(penumbraPerDepth(maps, light, tile) * height, reach), height);
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
