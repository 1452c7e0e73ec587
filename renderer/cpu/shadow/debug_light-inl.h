// What debug views show of one light's map: shaders/common_debug.glsl, sixteen at a time.
#if defined(GNOMON_CPU_DEBUG_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_DEBUG_LIGHT_INL_H
#undef GNOMON_CPU_DEBUG_LIGHT_INL_H
#else
#define GNOMON_CPU_DEBUG_LIGHT_INL_H
#endif

#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/shadow/shadow_visibility-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// What the views of one light are made from.
struct DebugLight {
  const ShadowMaps& maps;
  const shared::FrameData& frame;
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
HWY_INLINE Float2 pixelsAlong(const shared::FrameData& frame, const Receiver& receiver, const Float3& way) {
  glm::vec3 right(frame.right);
  glm::vec3 up(frame.up);
  right /= glm::dot(right, right);
  up /= glm::dot(up, up);
  Float2 moved(along(right, way), along(up, way));
  if (frame.perspective != 0u) {
    const Float2 place = Float2(along(right, receiver.relative), along(up, receiver.relative)) / receiver.viewDepth;
    moved = (moved - place * along(frame.forward, way)) / receiver.viewDepth;
  }
  return {moved.x / frame.pixelStep.x, moved.y / frame.pixelStep.y};
}

/// Texels' two edges as they lie on the surface's plane, seen on the picture: pixels, times `scale`.
struct TexelEdges {
  Float2 u;
  Float2 v;
  Float scale; ///< 0 where the light grazes the surface
};

/// How a row of the tile's matrix, divided by the last one, changes where it is `coordinate`: times the divisor.
HWY_INLINE Float3 gradient(const TileData& tile, int row, const Float& coordinate) {
  const glm::vec4 own = tile.atlasFromRelative[row];
  const glm::vec4 last = tile.atlasFromRelative[3];
  return {own.x - last.x * coordinate, own.y - last.y * coordinate, own.z - last.z * coordinate};
}

/// An edge e of the texel lies in the plane and crosses one texel of its own axis and none of the other. With the
/// gradients U and V of the two and the normal n: n e = 0, V e = 0, U e = 1, so that e = (V x n) / (n (U x V)).
HWY_INLINE TexelEdges texelEdges(const ServedReceiver& served, const DebugTexel& texel) {
  const shared::FrameData& frame = served.debug.frame;
  const Receiver& receiver = served.receiver;
  const glm::vec2 texels = served.debug.maps.atlasTexels;
  const Float3 u = gradient(texel.data, 0, texel.coordinate.x) * (texels.x / texel.divisor);
  const Float3 v = gradient(texel.data, 1, texel.coordinate.y) * (texels.y / texel.divisor);
  return {pixelsAlong(frame, receiver, cross(v, receiver.normal)),
          pixelsAlong(frame, receiver, cross(receiver.normal, u)), dot(receiver.normal, cross(u, v))};
}

/// Share of light squares in pixels whose sides span `width` texels. A square wave's integral is a triangle wave, whose
/// difference over the pixel is the square wave's mean there.
HWY_INLINE Float checkerboard(const Float& place, const Float& width) {
  const Float before = 1.0f - abs(2.0f * fract((place - 0.5f * width) * 0.5f) - 1.0f);
  const Float after = 1.0f - abs(2.0f * fract((place + 0.5f * width) * 0.5f) - 1.0f);
  return (after - before) / width;
}

/// View texelGrid. As bright as the scene, `shown`, but never so dark that the squares can't be told apart.
inline Float3 texelGrid(const DebugLight& debug, const Float3& shown, const Receiver& receiver) {
  const Float grey = 0.15f + 0.85f * clamp(luminance(shown), 0.0f, 1.0f);
  Float3 color(grey);
  if (!hasTiles(debug)) return color;
  const ServedReceiver served = servedReceiver(debug, receiver);
  for (int i = 0; i < static_cast<int>(served.light.tileCount); ++i) {
    const DebugTexel texel = debugTexel(served, i);
    if (none(texel.found)) continue;
    const TexelEdges edges = texelEdges(served, texel);
    const Float area = max(abs(edges.u.x * edges.v.y - edges.u.y * edges.v.x), 1e-30f);
    const Float texels = abs(edges.scale) / area;
    const Float meanX =
        checkerboard(texel.coordinate.x * debug.maps.atlasTexels.x, max(length(edges.v) * texels, 0.02f));
    const Float meanY =
        checkerboard(texel.coordinate.y * debug.maps.atlasTexels.y, max(length(edges.u) * texels, 0.02f));
    const Float light = mix(0.3f, 1.0f, 0.5f + 0.5f * meanX * meanY);
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

/// View texelDensity: the largest extent in pixels of the texel under the point: the greater singular value of its two
/// edges. (Lloyd et al., "Logarithmic Perspective Shadow Maps", 2008: the aliasing error m.) At most what 16 bits of an
/// EXR can hold.
HWY_INLINE Float texelDensity(const TexelEdges& edges) {
  const Float uu = dot(edges.u, edges.u);
  const Float vv = dot(edges.v, edges.v);
  const Float uv = dot(edges.u, edges.v);
  const Float greatest = sqrt(0.5f * (uu + vv + sqrt((uu - vv) * (uu - vv) + 4.0f * uv * uv)));
  return min(greatest / max(abs(edges.scale), 1e-30f), 65504.0f);
}

inline DebugValue densityValue(const DebugLight& debug, const Receiver& receiver, bool encoded) {
  const auto density = [](const ServedReceiver& served, const DebugTexel& texel)
                           HWY_ATTR { return texelDensity(texelEdges(served, texel)); };
  const TexelValue value = texelValue(debug, receiver, density);
  return encoded ? heatValue(value.found, 0.5f + log2(max(value.number, 1e-30f)) / 8.0f) : number(value.number);
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
  const Float3 a = gradient(texel.data, 0, at.coordinate.x);
  const Float3 b = gradient(texel.data, 1, at.coordinate.y);
  const Float3 c = gradient(texel.data, 2, at.coordinate.z);
  const Float3 off = (at.coordinate - texel.coordinate) * texel.divisor;
  const Float3 bc = cross(b, c);
  const Float3 moved = (bc * off.x + cross(c, a) * off.y + cross(a, b) * off.z) / dot(a, bc);
  return select(at.inside, length(moved), 0.0f);
}

inline DebugValue biasValue(const DebugLight& debug, const Receiver& receiver, bool encoded) {
  const auto metres = [](const ServedReceiver& served, const DebugTexel& texel)
                          HWY_ATTR { return biasMetres(served, texel); };
  const TexelValue value = texelValue(debug, receiver, metres);
  constexpr float decades = 0.30103f; // of an octave
  return encoded ? heatValue(value.found, 1.0f + 0.25f * decades * log2(max(value.number, 1e-9f)))
                 : number(value.number);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
