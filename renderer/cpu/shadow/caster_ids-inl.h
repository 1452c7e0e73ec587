// View casterIds: the node that shadows a place, as shaders/common_debug.glsl has it.
#if defined(GNOMON_CPU_CASTER_IDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_CASTER_IDS_INL_H
#undef GNOMON_CPU_CASTER_IDS_INL_H
#else
#define GNOMON_CPU_CASTER_IDS_INL_H
#endif

#include <bit>

#include "protocol/spec/output_options.h"
#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/shadow/debug_light-inl.h"
#include "renderer/prepare/draw_list.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The node of the triangle that is nearest to the light in texels of the tile; -1 = none.
HWY_INLINE Int nodeAt(const DebugLight& debug, const TileMap& casters, const Int& index) {
  static_assert((kClusterTriangles & (kClusterTriangles - 1)) == 0);
  constexpr int bits = std::countr_zero(kClusterTriangles);
  const Int number = gather(casters.depths->triangles.data(), index);
  const Mask none = number == Int(static_cast<std::int32_t>(kNoNumber));
  const Int slot = select(none, Int(0), shiftRightUnsigned<bits>(number));
  return select(none, Int(-1), gather(debug.slotNodes.data(), slot));
}

/// In the texels that the receivers are looked up in; -1 where none stands before them.
inline Int casterNodes(const DebugLight& debug, const Receiver& shown) {
  Int nodes = -1;
  if (!hasTiles(debug)) return nodes;
  const LightData& light = debug.maps.lights[debug.light];
  const Receiver receiver = shadedReceiver(light, shown, towardsLight(light, shown.relative)).receiver;
  const ServedReceiver served = servedReceiver(debug, receiver);
  for (int i = 0; i < static_cast<int>(served.light.tileCount); ++i) {
    const DebugTexel texel = debugTexel(served, i);
    if (none(texel.found)) continue;
    const TileMap& casters = debug.casters[texel.tile];
    Lookup at = lookupIn(served.light, texel.data, receiver, served.toLight);
    const Float2 slope = comparedSlope(served.light, texel.data, receiver.relative, receiver.normal);
    const Float2 place = Float2(at.coordinate.x, at.coordinate.y) * Float2(debug.maps.atlasTexels) -
                         Float2(static_cast<float>(casters.rect.x), static_cast<float>(casters.rect.y));
    const Int x = truncated(place.x);
    const Int y = truncated(place.y);
    at.coordinate.z -= bendRoom(served.light, texel.data, at.divisor, slope, 1.0f);
    const Float plane = at.coordinate.z + dot(slope, Float2(toFloat(x) + 0.5f, toFloat(y) + 0.5f) - place);
    const Int index = columnIndex(casters, x) + rowIndex(casters, y);
    const Mask shadowed = texel.found & at.inside & andNot(isLit(plane, depthAt(casters, index)), maskOf(0xffffu));
    nodes = select(shadowed, nodeAt(debug, casters, index), nodes);
  }
  return nodes;
}

/// A hue for each index, far from those of its neighbours: steps of the golden ratio.
HWY_INLINE Float3 nodeColor(const Int& node) {
  const Float count = toFloat(node + Int(1));
  const Float step = fract(count * 0.61803399f);
  const Float paleness = 0.55f + 0.4f * fract(count * 0.75487767f);
  const Float brightness = 0.7f + 0.3f * fract(count * 0.56984029f);
  Float3 hue;
  Float* const channels[] = {&hue.x, &hue.y, &hue.z};
  const float turns[] = {0.0f, 2.0f / 3.0f, 1.0f / 3.0f};
  for (int i = 0; i < 3; ++i) {
    const Float full = clamp(abs(fract(step + turns[i]) * 6.0f - 3.0f) - 1.0f, 0.0f, 1.0f);
    *channels[i] = mix(1.0f, full, paleness) * brightness;
  }
  return hue;
}

inline DebugValue casterValue(const DebugLight& debug, const Receiver& receiver, bool encoded) {
  const Int nodes = casterNodes(debug, receiver);
  if (!encoded) return number(toFloat(nodes));
  const Float3 toEye = debug.frame.perspective != 0u ? -normalize(receiver.relative) : Float3(-debug.frame.forward);
  const Float3 lit(0.25f + 0.35f * abs(dot(receiver.normal, toEye)));
  return {select(nodes < Int(0), lit, nodeColor(nodes)), 1.0f};
}

/// What a view of one light's numbers shows of receivers: texelDensity, blendWeight, bias or casterIds.
inline DebugValue debugData(const DebugLight& debug, View view, bool encoded, const Receiver& receiver) {
  if (view == View::texelDensity) return densityValue(debug, receiver, encoded);
  if (view == View::blendWeight) return blendValue(debug, receiver);
  if (view == View::bias) return biasValue(debug, receiver, encoded);
  return casterValue(debug, receiver, encoded);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
