// What debug views show of one light's map: shaders/common_debug.glsl, sixteen at a time.
#if defined(GNOMON_CPU_DEBUG_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_DEBUG_LIGHT_INL_H
#undef GNOMON_CPU_DEBUG_LIGHT_INL_H
#else
#define GNOMON_CPU_DEBUG_LIGHT_INL_H
#endif

#include <bit>

#include "protocol/spec/output_options.h"
#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/shadow/shadow_visibility-inl.h"
#include "renderer/prepare/draw_list.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// What the views of one light are made from.
struct DebugLight {
  const ShadowMaps& maps;
  const FrameData& frame;
  int light = -1;                               ///< -1 = there is none
  std::span<const TileMap> casters = {};        ///< parallel to maps.tiles, numbered, a sample a texel; view casterIds
  std::span<const std::int32_t> slotNodes = {}; ///< the node of each slot of triangle numbers; view casterIds
};

HWY_INLINE bool hasTiles(const DebugLight& debug) {
  return debug.light >= 0 && debug.maps.lights[debug.light].tileCount > 0u;
}

/// Unit length.
HWY_INLINE Float3 towardsLight(const LightData& light, const Float3& relative) {
  Float3 toLight;
  irradiance(light, relative, toLight);
  return toLight;
}

/// Receivers, and which tile of a light that has tiles each is looked up in.
struct ServedReceiver {
  const DebugLight& debug;
  const LightData& light;
  const Receiver& receiver;
  Float3 toLight;
  TileChoice choice;
};

HWY_INLINE ServedReceiver servedReceiver(const DebugLight& debug, const Receiver& receiver) {
  const LightData& light = debug.maps.lights[debug.light];
  const Float3 toLight = towardsLight(light, receiver.relative);
  return {debug, light, receiver, toLight, chooseTile(debug.maps, light, receiver, toLight)};
}

/// The texels of one tile under the receivers, where no bias has moved these.
struct DebugTexel {
  Mask found; ///< lanes that have one in this tile
  int tile;   ///< of all tiles; of two that are blended, the nearer
  const TileData& data;
  Float3 coordinate; ///< atlas u, v and depth
  Float divisor;     ///< of the coordinate
};

/// `index`: among the light's tiles.
HWY_INLINE DebugTexel debugTexel(const ServedReceiver& served, int index) {
  const int number = static_cast<int>(served.light.firstTile) + index;
  const TileData& tile = served.debug.maps.tiles[number];
  const Float divisor = along(tile.atlasFromRelative[3], served.receiver.relative);
  const Float3 coordinate = projected(tile, served.receiver.relative) / divisor;
  const Mask chosen = served.receiver.shown & served.choice.covered & (served.choice.first == Int(index));
  return {chosen & (divisor > 0.0f) & isWithin(coordinate, tile), number, tile, coordinate, divisor};
}

/// Pixels that points cross on the picture for each metre that they move along `way`.
HWY_INLINE Float2 pixelsAlong(const FrameData& frame, const Receiver& receiver, const Float3& way) {
  const glm::vec3 right = frame.right / glm::dot(frame.right, frame.right);
  const glm::vec3 up = frame.up / glm::dot(frame.up, frame.up);
  return pixelsAlong(frame, Float3(right), Float3(up), receiver.relative, receiver.viewDepth, way);
}

HWY_INLINE TexelEdges texelEdges(const ServedReceiver& served, const DebugTexel& texel) {
  const FrameData& frame = served.debug.frame;
  const Receiver& receiver = served.receiver;
  const TexelSides sides =
      texelSides(texel.data, texel.coordinate, texel.divisor, receiver.normal, Float2(served.debug.maps.atlasTexels));
  return {pixelsAlong(frame, receiver, sides.u), pixelsAlong(frame, receiver, sides.v), sides.scale};
}

/// View texelGrid.
inline Float3 texelGrid(const DebugLight& debug, const Float3& shown, const Receiver& receiver) {
  const Float grey = gridGrey(luminance(shown));
  Float3 color(grey);
  if (!hasTiles(debug)) return color;
  const ServedReceiver served = servedReceiver(debug, receiver);
  for (int i = 0; i < static_cast<int>(served.light.tileCount); ++i) {
    const DebugTexel texel = debugTexel(served, i);
    if (none(texel.found)) continue;
    const Float light = gridLight(texelEdges(served, texel), texel.coordinate.x * debug.maps.atlasTexels.x,
                                  texel.coordinate.y * debug.maps.atlasTexels.y);
    color = select(texel.found, Float3(kTints[i]) * (grey * light), color);
  }
  return color;
}

/// What a view of numbers shows: color or the number itself.
struct DebugValue {
  Float3 color;
  Float alpha;
};

HWY_INLINE DebugValue number(const Float& value) {
  return {Float3(value), value};
}

/// `at`: place on the heat map; 0 in all channels where there is nothing.
HWY_INLINE DebugValue heatValue(const Mask& found, const Float& at) {
  return {select(found, heat(at), Float3(0.0f)), select(found, 1.0f, Float(0.0f))};
}

/// A number of the texels under receivers; 0 where there is none.
struct TexelValue {
  Mask found;
  Float number;
};

/// `measure(served, texel)`: of the texels of one tile.
template <class Measure>
HWY_INLINE TexelValue texelValue(const DebugLight& debug, const Receiver& receiver, const Measure& measure) {
  TexelValue value{maskOf(0), 0.0f};
  if (!hasTiles(debug)) return value;
  const ServedReceiver served = servedReceiver(debug, receiver);
  for (int i = 0; i < static_cast<int>(served.light.tileCount); ++i) {
    const DebugTexel texel = debugTexel(served, i);
    if (none(texel.found)) continue;
    value.number = select(texel.found, measure(served, texel), value.number);
    value.found = value.found | texel.found;
  }
  return value;
}

/// View texelDensity.
inline DebugValue densityValue(const DebugLight& debug, const Receiver& receiver, bool encoded) {
  const auto density = [](const ServedReceiver& served, const DebugTexel& texel)
                           HWY_ATTR { return texelDensity(texelEdges(served, texel)); };
  const TexelValue value = texelValue(debug, receiver, density);
  return encoded ? heatValue(value.found, heatOfDensity(value.number)) : number(value.number);
}

/// View blendWeight: the share of the next cascade.
inline DebugValue blendValue(const DebugLight& debug, const Receiver& receiver) {
  Float blend = 0.0f;
  if (hasTiles(debug)) {
    const ServedReceiver served = servedReceiver(debug, receiver);
    for (int i = 0; i < static_cast<int>(served.light.tileCount); ++i) {
      blend = select(debugTexel(served, i).found, served.choice.blend, blend);
    }
  }
  return number(blend);
}

/// View bias, metres: from the points to those that are looked up in their place. These are where the three planes of
/// their coordinates meet: row - coordinate * last row, for u, v and depth.
HWY_INLINE Float biasMetres(const ServedReceiver& served, const DebugTexel& texel) {
  Lookup at = lookupIn(served.light, texel.data, served.receiver, served.toLight);
  const Float2 slope = comparedSlope(served.light, texel.data, served.receiver.relative, served.receiver.normal);
  at.coordinate.z -= bendRoom(served.light, texel.data, at.divisor, slope, 1.0f);
  const Float3 a = rowGradient(texel.data, 0, at.coordinate.x);
  const Float3 b = rowGradient(texel.data, 1, at.coordinate.y);
  const Float3 c = rowGradient(texel.data, 2, at.coordinate.z);
  const Float3 off = (at.coordinate - texel.coordinate) * texel.divisor;
  const Float3 bc = cross(b, c);
  const Float3 moved = (bc * off.x + cross(c, a) * off.y + cross(a, b) * off.z) / dot(a, bc);
  return select(at.inside, length(moved), 0.0f);
}

inline DebugValue biasValue(const DebugLight& debug, const Receiver& receiver, bool encoded) {
  const auto metres = [](const ServedReceiver& served, const DebugTexel& texel)
                          HWY_ATTR { return biasMetres(served, texel); };
  const TexelValue value = texelValue(debug, receiver, metres);
  return encoded ? heatValue(value.found, heatOfMetres(value.number)) : number(value.number);
}

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

inline DebugValue casterValue(const DebugLight& debug, const Receiver& receiver, bool encoded) {
  const Int nodes = casterNodes(debug, receiver);
  if (!encoded) return number(toFloat(nodes));
  const Float3 toEye = debug.frame.perspective != 0u ? -normalize(receiver.relative) : Float3(-debug.frame.forward);
  const Float3 lit(greyWithoutCaster(dot(receiver.normal, toEye)));
  return {select(nodes < Int(0), lit, nodeColor(toFloat(nodes + Int(1)))), 1.0f};
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
