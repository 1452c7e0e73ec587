// What a light's map does to an edge of its shadow: shaders/displacement.frag, sixteen at a time.
#if defined(GNOMON_CPU_MAP_FOOTPRINTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_MAP_FOOTPRINTS_INL_H
#undef GNOMON_CPU_MAP_FOOTPRINTS_INL_H
#else
#define GNOMON_CPU_MAP_FOOTPRINTS_INL_H
#endif

#include "renderer/cpu/shadow/debug_light-inl.h"
#include "renderer/device/device.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Pixels, y DOWN.
HWY_INLINE Float2 pictured(const Float2& pixels) {
  return {clamp(pixels.x, -kMostPixels, kMostPixels), -clamp(pixels.y, -kMostPixels, kMostPixels)};
}

struct Footprints {
  Mask receives;                ///< lanes where the light reaches a surface that receives its shadow
  Float2 texelU, texelV, shift; ///< as MapFootprint; 0 where no tile serves the lane
  Int tile;
  Float penumbra; ///< as MapFootprint
};

/// Texels; 0 where filter pcss finds nothing, and with other filters. Lanes outside of `asked` hold anything.
inline Float penumbraTexels(const ServedReceiver& served, const DebugTexel& texel, const Mask& asked) {
  const LightData& light = served.light;
  const ShadowMaps& maps = served.debug.maps;
  if (light.filterKind != GNOMON_FILTER_PCSS || maps.maps[texel.tile].depths == nullptr) return 0.0f;
  const Lookup at = lookupIn(light, texel.data, served.receiver, served.toLight);
  if (none(at.inside & asked)) return 0.0f;
  const Float2 slope = comparedSlope(light, texel.data, served.receiver.relative, served.receiver.normal);
  const Float radius = penumbraRadius(maps, light, texel.tile, at, slope, served.receiver.place);
  return select(at.inside, texelsAcross(maps, texel.data, max(radius, 0.0f)), 0.0f);
}

/// Of the light of `debug`, which has tiles.
inline Footprints footprintsOf(const DebugLight& debug, const Receiver& shown) {
  const LightData& light = debug.maps.lights[debug.light];
  const Receiver receiver = shadedReceiver(light, shown, towardsLight(light, shown.relative)).receiver;
  const ServedReceiver served = servedReceiver(debug, receiver);
  const std::uint32_t groups = served.light.litGroups & served.light.shadowedGroups;
  Float3 toLight;
  const Float3 arriving = irradiance(served.light, receiver.relative, toLight);
  const Mask arrives = (arriving.x != 0.0f) | (arriving.y != 0.0f) | (arriving.z != 0.0f);
  const Mask grouped = (receiver.groupBit & Int(static_cast<std::int32_t>(groups))) != Int(0);
  const Float2 nothing(Float(0.0f));
  const Mask receives = andNot(isTurnedAway(receiver, toLight), receiver.shown & arrives & grouped);
  Footprints footprints{receives, nothing, nothing, nothing, 0, 0.0f};
  for (int i = 0; i < static_cast<int>(served.light.tileCount); ++i) {
    const DebugTexel texel = debugTexel(served, i);
    const Mask found = texel.found & receives;
    if (none(found)) continue;
    const TexelEdges edges = texelEdges(served, texel);
    const Float scale = edgeScale(edges);
    const Float2 shift = pixelsAlong(
        debug.frame, receiver, shiftOnSurface(light, texel.data, receiver.relative, receiver.normal, served.toLight));
    footprints.shift = select(found, pictured(shift), footprints.shift);
    footprints.texelU = select(found, pictured(edges.u / scale), footprints.texelU);
    footprints.texelV = select(found, pictured(edges.v / scale), footprints.texelV);
    footprints.tile = select(found, Int(i), footprints.tile);
    footprints.penumbra = select(found, penumbraTexels(served, texel, found), footprints.penumbra);
  }
  return footprints;
}

/// As a frame's footprints are passed on; of the first `count` lanes.
inline void storeFootprints(const Footprints& footprints, const Receiver& receiver, std::size_t count,
                            MapFootprint* out) {
  alignas(64) float lanes[11][kLanes];
  const Float* const values[] = {&footprints.texelU.x, &footprints.texelU.y, &footprints.texelV.x, &footprints.texelV.y,
                                 &footprints.shift.x,  &footprints.shift.y,  &receiver.normal.x,   &receiver.normal.y,
                                 &receiver.normal.z,   &receiver.viewDepth,  &footprints.penumbra};
  for (std::size_t i = 0; i < std::size(values); ++i) store(*values[i], lanes[i]);
  alignas(64) std::int32_t tiles[kLanes];
  store(footprints.tile, tiles);
  const unsigned receives = bitsOf(footprints.receives);
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = {};
    if ((receives >> i & 1u) == 0) continue;
    out[i].texelU = glm::vec2(lanes[0][i], lanes[1][i]);
    out[i].texelV = glm::vec2(lanes[2][i], lanes[3][i]);
    out[i].shift = glm::vec2(lanes[4][i], lanes[5][i]);
    out[i].normal = glm::vec3(lanes[6][i], lanes[7][i], lanes[8][i]);
    out[i].viewDepth = lanes[9][i];
    out[i].tile = tiles[i];
    out[i].penumbra = lanes[10][i];
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
