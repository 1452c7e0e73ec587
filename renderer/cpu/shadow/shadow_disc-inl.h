// Comparisons over a disc of the world: shaders/common_shadow_disc.glsl, sixteen at a time.
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

/// Cosine and sine by which each pixel turns the taps, so that their pattern shows as fine noise and not as bands.
/// (Jimenez, "Next Generation Post Processing in Call of Duty", 2014: interleaved gradient noise.)
HWY_INLINE Float2 discTurn(const Float2& place) {
  const Float noise = fract(52.9829189f * fract(place.x * 0.06711056f + place.y * 0.00583715f));
  const Float angle = 6.2831853f * noise;
  return {cos(angle), sin(angle)};
}

/// Of a disc so far before the receivers that all of it is above their planes.
inline constexpr float kWholeDisc = 1e30f;

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

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
