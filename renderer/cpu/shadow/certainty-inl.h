// Whether the shadow map of one light knows what arrives: shaders/certainty.frag, which tells why, sixteen at a time.
#if defined(GNOMON_CPU_CERTAINTY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_CERTAINTY_INL_H
#undef GNOMON_CPU_CERTAINTY_INL_H
#else
#define GNOMON_CPU_CERTAINTY_INL_H
#endif

#include <bit>

#include "renderer/cpu/shadow/debug_light-inl.h"
#include "renderer/prepare/outlines.h"
#include "renderer/techniques/traced_shadow.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// How much depths change along a surface with each length across, at most, where no outline is near: the tangent of
/// GNOMON_STEEPEST, for two surfaces that lean either way, and some room.
inline constexpr float kBend = 2.2f * static_cast<float>(GNOMON_STEEPEST);

HWY_INLINE Int verdictNumber(Verdict verdict) {
  return static_cast<std::int32_t>(verdict);
}

/// Lanes of `asked` whose cell of the tile has an outline.
inline Mask outlined(const TileMap& map, std::span<const std::uint8_t> outlines, const Int& x, const Int& y,
                     const Mask& asked) {
  alignas(64) std::int32_t cells[kLanes];
  store(keptWithin(y, map.rect.height) * Int(map.rect.width) + keptWithin(x, map.rect.width), cells);
  unsigned marked = 0;
  for (unsigned left = bitsOf(asked); left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    if (outlines[static_cast<std::size_t>(cells[lane])] != 0) marked |= 1u << lane;
  }
  return maskOf(marked);
}

/// What a tile knows of the lanes `asked`, which face the light.
inline Int tileVerdicts(const ServedReceiver& served, int tileIndex, std::span<const std::uint8_t> outlines,
                        const Float& cosine, const Mask& asked) {
  const Receiver& receiver = served.receiver;
  const ShadowMaps& maps = served.debug.maps;
  const TileData& tile = maps.tiles[tileIndex];
  const TileMap& map = maps.maps[tileIndex];
  const bool parallel = isParallel(tile);
  Float3 at = projected(tile, receiver.relative);
  // z that a length along the light is worth.
  Float perLength = glm::dot(glm::vec3(tile.atlasFromRelative[2]), tile.axis);
  Float rounding = tile.depthBias;
  Mask sure = asked;
  if (!parallel) {
    const Float divisor = along(tile.atlasFromRelative[3], receiver.relative);
    sure = sure & (divisor > 0.0f);
    at = at / divisor;
    perLength = tile.near * tile.far / ((tile.far - tile.near) * divisor);
    rounding += tile.depthBiasNear / (divisor * divisor);
  }
  sure = sure & isWithin(at, tile);
  const Float2 place = Float2(at.x, at.y) * Float2(maps.atlasTexels) -
                       Float2(static_cast<float>(map.rect.x), static_cast<float>(map.rect.y));
  const Float2 cell(floor(place.x - 0.5f), floor(place.y - 0.5f));
  const Int x = truncated(cell.x);
  const Int y = truncated(cell.y);
  sure = andNot(outlined(map, outlines, x, y, sure), sure);
  if (none(sure)) return verdictNumber(Verdict::unsure);

  const Float tangent = sqrt(max(1.0f - cosine * cosine, 0.0f)) / cosine;
  // A steep surface has an outline along all of its edges: away from them it is a plane.
  Float bend = select(tangent > static_cast<float>(GNOMON_STEEPEST), 0.0f, kBend * perLength);
  if (!parallel) bend += 2.0f * perLength; // depth is told along the tile's axis, slopes along the ray
  const Float unevenness = 2e-4f * (1.0f + tangent * tangent) * perLength; // of a normal of 16 bits an axis
  const Float2 slope = receiverSlope(tile, receiver, served.light.position);
  const glm::vec2 texelsPerMetre = tile.atlasPerMetre * maps.atlasTexels;
  Mask lit = sure;
  Mask shadow = sure;
  for (int i = 0; i < 4; ++i) {
    const Float2 across(cell.x + (static_cast<float>(i % 2) + 0.5f) - place.x,
                        cell.y + (static_cast<float>(i / 2) + 0.5f) - place.y);
    const Float apart = length(Float2(across.x / texelsPerMetre.x, across.y / texelsPerMetre.y));
    const Float plane = at.z + dot(slope, across);
    const Float depth = depthAt(map, x + Int(i % 2), y + Int(i / 2));
    const Float slack = rounding + unevenness * apart;
    // What lies before the map's first depth is drawn at 0: there it can't be told from a receiver.
    lit = lit & (depth > 0.0f) & (min(plane, 1.0f) - depth <= slack);
    shadow = shadow & (plane - depth > slack + bend * apart);
  }
  const Int known = select(shadow, verdictNumber(Verdict::shadow), verdictNumber(Verdict::unsure));
  return select(lit, verdictNumber(Verdict::lit), known);
}

/// A Verdict's number for each lane; lit where nothing is shown. Of the light of `debug`, which has tiles of one sample
/// a texel. `outlines`: of each of its tiles.
inline Int verdicts(const DebugLight& debug, const Receiver& receiver, std::span<const TileOutlines> outlines) {
  const ServedReceiver served = servedReceiver(debug, receiver);
  Float3 toLight;
  const Float3 arriving = irradiance(served.light, receiver.relative, toLight);
  const Mask arrives = (arriving.x != 0.0f) | (arriving.y != 0.0f) | (arriving.z != 0.0f);
  const std::uint32_t groups = served.light.litGroups & served.light.shadowedGroups;
  const Mask asked =
      receiver.shown & arrives & ((receiver.groupBit & Int(static_cast<std::int32_t>(groups))) != Int(0));
  if (none(asked)) return verdictNumber(Verdict::lit);
  const Float cosine = dot(receiver.normal, toLight);
  const Mask facing = asked & (cosine > 1e-3f) & served.choice.covered;
  Int known = select(cosine < -1e-3f, verdictNumber(Verdict::turnedAway), verdictNumber(Verdict::unsure));
  for (int i = 0; i < static_cast<int>(served.light.tileCount); ++i) {
    const Mask own = facing & (served.choice.first == Int(i));
    const int tile = static_cast<int>(served.light.firstTile) + i;
    if (none(own) || debug.maps.maps[tile].depths == nullptr) continue;
    known = select(own, tileVerdicts(served, tile, outlines[i], cosine, own), known);
  }
  return select(asked, known, verdictNumber(Verdict::lit));
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
