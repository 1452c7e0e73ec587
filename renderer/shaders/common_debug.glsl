// What the debug views show of one light.
#include "shared/debug_light.h"
layout(location = GNOMON_DEBUG_LIGHT) uniform int debugLight; // -1: the frame has none
layout(location = GNOMON_ATLAS_SIZE) uniform vec2 atlasTexels;

bool hasTiles() { return debugLight >= 0 && lights[debugLight].tileCount > 0u; }

vec3 towardsDebugLight(Receiver receiver) {
  vec3 toLight;
  irradiance(lights[debugLight], receiver.relative, toLight);
  return toLight;
}

// The texel of the debug light under a receiver, where no bias has moved that.
struct DebugTexel {
  bool found; // false: the light has none there
  int tile;   // among the light's; the nearer of two that are blended
  float blend; // share of the next one
  TileData data;
  vec3 coordinate; // atlas u, v and depth
  float divisor;   // of the coordinate
};

DebugTexel debugTexel(Receiver receiver) {
  DebugTexel texel;
  texel.found = hasTiles();
  if (!texel.found) return texel;
  TileChoice choice = chooseTile(debugLight, receiver, towardsDebugLight(receiver));
  texel.tile = choice.first;
  texel.blend = choice.blend;
  texel.data = tiles[lights[debugLight].firstTile + choice.first];
  vec4 p = vec4(receiver.relative, 1.0);
  texel.divisor = dot(texel.data.atlasFromRelative[3], p);
  texel.coordinate = vec3(dot(texel.data.atlasFromRelative[0], p), dot(texel.data.atlasFromRelative[1], p),
                          dot(texel.data.atlasFromRelative[2], p)) / texel.divisor;
  texel.found = choice.covered && texel.divisor > 0.0 &&
                all(greaterThanEqual(texel.coordinate.xy, texel.data.lowest)) &&
                all(lessThanEqual(texel.coordinate.xy, texel.data.highest));
  return texel;
}

#if defined(VIEW_TEXEL_GRID) || defined(VIEW_TEXEL_DENSITY) || defined(TEXEL_EDGES)
vec2 pixelsAlong(Receiver receiver, vec3 way) {
  vec3 right = frame.right / dot(frame.right, frame.right);
  vec3 up = frame.up / dot(frame.up, frame.up);
  return pixelsAlong(frame, right, up, receiver.relative, receiver.viewDepth, way);
}

TexelEdges texelEdges(DebugTexel texel, Receiver receiver) {
  TexelSides sides = texelSides(texel.data, texel.coordinate, texel.divisor, receiver.normal, atlasTexels);
  return TexelEdges(pixelsAlong(receiver, sides.u), pixelsAlong(receiver, sides.v), sides.scale);
}
#endif

#ifdef VIEW_TEXEL_GRID
vec3 texelGrid(vec3 shown, Receiver receiver) {
  vec3 grey = vec3(gridGrey(luminance(shown)));
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return grey;
  vec2 place = texel.coordinate.xy * atlasTexels;
  return grey * kTints[texel.tile] * gridLight(texelEdges(texel, receiver), place.x, place.y);
}
#endif

#ifdef VIEW_TEXEL_DENSITY
vec4 debugData(Receiver receiver) {
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return vec4(0.0);
  float density = texelDensity(texelEdges(texel, receiver));
#ifdef ENCODED
  return vec4(heat(heatOfDensity(density)), 1.0);
#else
  return vec4(density);
#endif
}
#endif

#ifdef VIEW_BLEND_WEIGHT
vec4 debugData(Receiver receiver) {
  DebugTexel texel = debugTexel(receiver);
  return vec4(texel.found ? texel.blend : 0.0);
}
#endif

#ifdef VIEW_BIAS
// From the point to the one that is looked up in its place. That is where the three planes of its coordinates meet:
// row - coordinate * last row, for u, v and depth.
float biasMetres(DebugTexel texel, Receiver receiver) {
  Lookup at = lookupIn(lights[debugLight], texel.data, receiver, towardsDebugLight(receiver));
  if (!at.inside) return 0.0;
  vec2 slope = comparedSlope(lights[debugLight], texel.data, receiver.relative, receiver.normal);
  at.coordinate.z -= bendRoom(lights[debugLight], texel.data, at.divisor, slope, 1.0);
  mat3 planes = mat3(rowGradient(texel.data, 0, at.coordinate.x), rowGradient(texel.data, 1, at.coordinate.y),
                     rowGradient(texel.data, 2, at.coordinate.z));
  return length(inverse(transpose(planes)) * ((at.coordinate - texel.coordinate) * texel.divisor));
}

vec4 debugData(Receiver receiver) {
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return vec4(0.0);
  float metres = biasMetres(texel, receiver);
#ifdef ENCODED
  return vec4(heat(heatOfMetres(metres)), 1.0);
#else
  return vec4(metres);
#endif
}
#endif

#ifdef VIEW_CASTER_IDS
layout(binding = GNOMON_CASTER_NODE_UNIT) uniform isampler2D casterNodes;
layout(binding = GNOMON_CASTER_DEPTH_UNIT) uniform sampler2D casterDepths;

// The node in the texel that the receiver is looked up in; -1 where none stands before it.
int casterNode(Receiver receiver) {
  if (!hasTiles()) return -1;
  receiver = shadedReceiver(lights[debugLight], receiver, towardsDebugLight(receiver));
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return -1;
  Lookup at = lookupIn(lights[debugLight], texel.data, receiver, towardsDebugLight(receiver));
  vec2 slope = comparedSlope(lights[debugLight], texel.data, receiver.relative, receiver.normal);
  vec2 place = at.coordinate.xy * atlasTexels;
  ivec2 under = ivec2(place);
  at.coordinate.z -= bendRoom(lights[debugLight], texel.data, at.divisor, slope, 1.0);
  float plane = at.coordinate.z + dot(slope, vec2(under) + 0.5 - place);
  if (!at.inside || mapDepths(vec4(plane)).x <= texelFetch(casterDepths, under, 0).r) return -1;
  return texelFetch(casterNodes, under, 0).r;
}

vec4 debugData(Receiver receiver) {
  int node = casterNode(receiver);
#ifdef ENCODED
  vec3 toEye = frame.perspective != 0u ? -normalize(receiver.relative) : -frame.forward;
  vec3 lit = vec3(greyWithoutCaster(dot(receiver.normal, toEye)));
  return vec4(node < 0 ? lit : nodeColor(float(node + 1)), 1.0);
#else
  return vec4(float(node));
#endif
}
#endif
