// Visibility of a light through its tiles, or its visibility layer: shaders/common_shadow.glsl, sixteen at a time.
#if defined(GNOMON_CPU_SHADOW_VISIBILITY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_VISIBILITY_INL_H
#undef GNOMON_CPU_SHADOW_VISIBILITY_INL_H
#else
#define GNOMON_CPU_SHADOW_VISIBILITY_INL_H
#endif

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/shadow/baked_lookup-inl.h"
#include "renderer/cpu/shadow/shadow_disc-inl.h"
#include "renderer/cpu/shadow/shadow_filter-inl.h"
#include "renderer/cpu/shadow/shadow_lookup-inl.h"
#include "renderer/cpu/shadow/shadow_texels-inl.h"
#include "renderer/shadow/filter_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

static_assert(kMapReadingKinds.size() == 6, "A new reading of maps needs its lookup and its reach here.");

/// Share of the light that one tile lets through; 1 outside of what the tile covers. The bounds leave the filter room:
/// no lookup of it leaves the tile. Lanes outside of `asked` hold anything.
inline Float tileVisibility(const ShadowMaps& maps, const LightData& light, int tileIndex, const Receiver& receiver,
                            const Float3& toLight, const Mask& asked) {
  const TileData& tile = maps.tiles[tileIndex];
  const TileMap& map = maps.maps[tileIndex];
  if (map.depths == nullptr) return 1.0f;
  Lookup at = lookupIn(light, tile, receiver, toLight);
  const Mask read = asked & at.inside;
  if (none(read)) return 1.0f;
  const Float2 place = placeIn(maps, map, at);
  if (GNOMON_READS_MOMENTS(light.filterKind)) {
    return select(at.inside,
                  momentVisibility(map, place, momentDepth(tile, at.coordinate.z, at.divisor), light.filterKind), 1.0f);
  }
  const Float2 slope = comparedSlope(light, tile, receiver.relative, receiver.normal);
  if (light.filterKind == GNOMON_FILTER_DISC) {
    at.coordinate.z -=
        bendRoom(light, tile, at.divisor, slope, 1.0f + texelsAcross(maps, tile, light.filterRadius) / at.divisor);
    const Float across = discRadius(tile, light.filterRadius, at.divisor);
    return select(at.inside, discVisibility(maps, tileIndex, at, slope, across, kWholeDisc, receiver.place, read),
                  1.0f);
  }
  if (light.filterKind == GNOMON_FILTER_PCSS) {
    const Float lit = pcssVisibility(maps, light, tileIndex, at, slope, receiver.place, read);
    return select(at.inside, lit * shareAbovePlane(light, receiver.relative, receiver.normal, toLight), 1.0f);
  }
  at.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 0.5f * static_cast<float>(light.filterSize + 1));
  return select(at.inside, squareVisibility(map, place, {at.coordinate.z, slope}, light.filterSize, read), 1.0f);
}

/// Texels to each side of a lookup that the light's filter reads, along x and y. A kernel's comparisons are bilinear,
/// so that it takes half a texel more than its outermost one; so do taps of a disc, and moments.
HWY_INLINE Float2 filterReach(const ShadowMaps& maps, const LightData& light, const TileData& tile, const Lookup& at) {
  constexpr float kRounding = 1.0f / 64; // of places, texels
  if (light.filterKind == GNOMON_FILTER_DISC || light.filterKind == GNOMON_FILTER_PCSS) {
    const Float radius = light.filterKind == GNOMON_FILTER_DISC
                             ? discRadius(tile, light.filterRadius, at.divisor)
                             : searchReach(tile, penumbraPerDepth(maps, light, tile), at.coordinate.z);
    const glm::vec2 texels = tile.atlasPerMetre * maps.atlasTexels;
    return {radius * texels.x + (0.5f + kRounding), radius * texels.y + (0.5f + kRounding)};
  }
  const float size = GNOMON_READS_MOMENTS(light.filterKind) ? 1.0f : static_cast<float>(std::max(light.filterSize, 1));
  return Float2(Float(0.5f * size + kRounding));
}

/// Whether corners give what a light's pixels read: what they read is as far around each, whatever its depth.
HWY_INLINE bool readsAlike(const LightData& light) {
  return light.type == GNOMON_DIRECTIONAL && light.filterKind != GNOMON_FILTER_PCSS;
}

HWY_INLINE Mask isTurnedAway(const Receiver& receiver, const Float3& toLight) {
  return dot(receiver.normal, toLight) <= kTurnedAway;
}

/// Receivers as their shadows are looked up in a light's map, and where it is from there.
struct ShadedReceiver {
  Receiver receiver;
  Float3 toLight; ///< unit length
};

/// Where a triangle leaves some of the light behind its plane, the curved surface that shading shows takes its place,
/// if that faces more of it.
HWY_INLINE ShadedReceiver shadedReceiver(const LightData& light, const Receiver& receiver, const Float3& toLight) {
  ShadedReceiver shaded{receiver, toLight};
  if (light.smoothTerminator == 0u || none(receiver.smooth.bends)) return shaded;
  const Float whole = wholeLightCosine(light, receiver.relative);
  const Float cosine = dot(receiver.normal, toLight);
  const SmoothPlace& smooth = receiver.smooth;
  const Mask stands = smooth.bends & (cosine <= whole) & (smoothGain(cosine, dot(smooth.normal, toLight)) > 0.0f);
  if (none(stands)) return shaded;
  shaded.receiver.smooth.lifted = stands;
  shaded.receiver.normal = select(stands, smooth.normal, receiver.normal);
  shaded.receiver.relative = select(stands, receiver.relative + smooth.normal * smooth.height, receiver.relative);
  if (light.type != GNOMON_DIRECTIONAL) {
    shaded.toLight = select(stands, normalize(Float3(light.position) - shaded.receiver.relative), toLight);
  }
  return shaded;
}

/// The mean over the samples of each pixel that show the receiver. Lanes outside of `asked` hold anything.
inline Float layerValue(const Layer& layer, const Receiver& receiver, const Mask& asked) {
  const Int pixel = truncated(receiver.place.y) * Int(layer.width) + truncated(receiver.place.x);
  if (layer.samples == 1) {
    const std::int32_t corner = firstLane(pixel);
    const Int inBlock = (laneNumbers() & Int(3)) + shiftRight<2>(laneNumbers()) * Int(layer.width);
    const Int values = all(pixel == Int(corner) + inBlock)
                           ? loadRows(layer.values + corner, static_cast<std::size_t>(layer.width))
                           : gather(layer.values, select(asked, pixel, Int(0)));
    return toFloat(values) * (1.0f / 65535.0f);
  }
  const Int first = select(asked, pixel, Int(0)) * Int(layer.samples);
  Int sum(0);
  Int count(0);
  for (int i = 0; i < layer.samples; ++i) {
    const Mask shows = (receiver.samples & Int(1 << i)) != Int(0);
    sum = select(shows, sum + gather(layer.values, first + Int(i)), sum);
    count = select(shows, count + Int(1), count);
  }
  return toFloat(sum) / (max(toFloat(count), 1.0f) * 65535.0f);
}

/// Lanes that the light throws shadows on.
HWY_INLINE Mask receivesShadow(const LightData& light, const Receiver& receiver) {
  return (receiver.groupBit & Int(static_cast<std::int32_t>(light.shadowedGroups))) != Int(0);
}

/// By the light's visibility layer, which it has; otherwise as shadowVisibility.
inline Float layerVisibility(const ShadowMaps& maps, const LightData& light, const Receiver& receiver,
                             const Float3& toLight, const Mask& needed) {
  const Mask receives = receivesShadow(light, receiver);
  const Mask asked = needed & receiver.shown & receives;
  const Layer& layer = maps.layers[light.visibilityLayer - 1];
  Float visibility =
      layer.baked != nullptr ? bakedValue(*layer.baked, receiver, asked) : layerValue(layer, receiver, asked);
  // Rays know which faces are turned away, light maps don't.
  if (light.layerOmitsTurnedFaces != 0u) visibility = select(isTurnedAway(receiver, toLight), 0.0f, visibility);
  return select(receives, mix(1.0f, visibility, light.strength), 1.0f);
}

/// Which of a light's tiles are looked up for which lanes.
struct MapReads {
  TileChoice choice;
  Mask served; ///< lanes whose shadow the tiles know
  Mask asked;  ///< of these, the ones that texels are read for

  /// Lanes that read the light's tile `index`.
  HWY_INLINE Mask of(int index) const { return asked & ((choice.first == Int(index)) | (choice.second == Int(index))); }
};

/// Of a light that has tiles.
HWY_INLINE MapReads mapReads(const ShadowMaps& maps, const LightData& light, const Receiver& receiver,
                             const Float3& toLight, const Mask& needed) {
  MapReads reads;
  reads.choice = chooseTile(maps, light, receiver, toLight);
  reads.served = receivesShadow(light, receiver) & reads.choice.covered;
  reads.asked = andNot(isTurnedAway(receiver, toLight), needed & receiver.shown & reads.served);
  return reads;
}

/// By the light's tiles; 1 where it has none. Otherwise as shadowVisibility.
inline Float mapVisibility(const ShadowMaps& maps, const LightData& light, const Receiver& shown,
                           const Float3& shownToLight, const Mask& needed) {
  if (light.tileCount == 0u || none(needed & shown.shown)) return 1.0f;
  const auto [receiver, toLight] = shadedReceiver(light, shown, shownToLight);
  const MapReads reads = mapReads(maps, light, receiver, toLight, needed);
  Float visibility = 0.0f;
  for (int i = 0; i < static_cast<int>(light.tileCount) && any(reads.asked); ++i) {
    const Mask read = reads.of(i);
    if (none(read)) continue;
    const Float share = select(reads.choice.first == Int(i), 1.0f - reads.choice.blend, reads.choice.blend);
    const Float lit = tileVisibility(maps, light, static_cast<int>(light.firstTile) + i, receiver, toLight, read);
    visibility += select(read, share * lit, 0.0f);
  }
  visibility = mix(visibility, 1.0f, reads.choice.fade);
  return select(reads.served, mix(1.0f, visibility, light.strength), 1.0f);
}

/// `visibility` of surfaces alone, and what volumes let through of that: both are shadow, of one strength.
inline HWY_NOINLINE Float throughVolumes(const ShadowMaps& maps, const LightData& light, const Receiver& receiver,
                                         const Float& visibility, const Mask& needed) {
  const Mask receives = receivesShadow(light, receiver);
  const Float share = layerValue(maps.volumes, receiver, needed & receiver.shown & receives);
  const float left = 1.0f - light.strength;
  return select(receives, left + (visibility - left) * share, visibility);
}

/// What share of `light` reaches the receivers, 0 to 1, by the strength of its shadow. `toLight`: unit length. Lanes
/// that are not `needed`, because no light arrives anyway, hold anything in 0 to 1.
inline Float shadowVisibility(const ShadowMaps& maps, int light, const Receiver& receiver, const Float3& toLight,
                              const Mask& needed) {
  const LightData& data = maps.lights[light];
  const Float visibility = data.visibilityLayer > 0u ? layerVisibility(maps, data, receiver, toLight, needed)
                                                     : mapVisibility(maps, data, receiver, toLight, needed);
  return light == maps.volumeLight ? throughVolumes(maps, data, receiver, visibility, needed) : visibility;
}

/// The cascades from near to far, or a light's faces; white beyond. Of a light that has tiles.
inline Float3 cascadeTint(const ShadowMaps& maps, int light, const Receiver& receiver, const Float3& toLight) {
  const LightData& data = maps.lights[light];
  const TileChoice choice = chooseTile(maps, data, receiver, toLight);
  Float3 first(Float(1.0f));
  Float3 second(Float(1.0f));
  for (int i = 0; i < static_cast<int>(data.tileCount); ++i) {
    first = select(choice.first == Int(i), Float3(kTints[i]), first);
    second = select(choice.second == Int(i), Float3(kTints[i]), second);
  }
  const Float3 white(Float(1.0f));
  return select(choice.covered, mix(mix(first, second, choice.blend), white, choice.fade), white);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
