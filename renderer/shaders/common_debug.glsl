// What the debug views show of one light.
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
// Pixels that a point crosses on the picture for each metre that it moves along `way`.
vec2 pixelsAlong(Receiver receiver, vec3 way) {
  vec3 right = frame.right / dot(frame.right, frame.right);
  vec3 up = frame.up / dot(frame.up, frame.up);
  vec2 moved = vec2(dot(way, right), dot(way, up));
  if (frame.perspective != 0u) {
    vec2 place = vec2(dot(receiver.relative, right), dot(receiver.relative, up)) / receiver.viewDepth;
    moved = (moved - place * dot(way, frame.forward)) / receiver.viewDepth;
  }
  return moved / frame.pixelStep;
}

// A texel's two edges as they lie on the surface's plane, seen on the picture: pixels, times `scale`.
struct TexelEdges {
  vec2 u;
  vec2 v;
  float scale; // 0 where the light grazes the surface
};

// An edge e of the texel lies in the plane and crosses one texel of its own axis and none of the other. With the
// gradients U and V of the two and the normal n: n e = 0, V e = 0, U e = 1, so that e = (V x n) / (n (U x V)).
TexelEdges texelEdges(DebugTexel texel, Receiver receiver) {
  vec3 last = texel.data.atlasFromRelative[3].xyz;
  vec3 u = (texel.data.atlasFromRelative[0].xyz - texel.coordinate.x * last) * (atlasTexels.x / texel.divisor);
  vec3 v = (texel.data.atlasFromRelative[1].xyz - texel.coordinate.y * last) * (atlasTexels.y / texel.divisor);
  return TexelEdges(pixelsAlong(receiver, cross(v, receiver.normal)), pixelsAlong(receiver, cross(receiver.normal, u)),
                    dot(receiver.normal, cross(u, v)));
}
#endif

#ifdef VIEW_TEXEL_GRID
// Share of light squares in a pixel whose sides span `width` texels. A square wave's integral is a triangle wave, whose
// difference over the pixel is the square wave's mean there.
float checkerboard(vec2 place, vec2 width) {
  vec2 before = 1.0 - abs(2.0 * fract((place - 0.5 * width) * 0.5) - 1.0);
  vec2 after = 1.0 - abs(2.0 * fract((place + 0.5 * width) * 0.5) - 1.0);
  vec2 mean = (after - before) / width;
  return 0.5 + 0.5 * mean.x * mean.y;
}

// As bright as the scene, but never so dark that the squares can't be told apart.
vec3 texelGrid(vec3 shown, Receiver receiver) {
  vec3 grey = vec3(0.15 + 0.85 * clamp(luminance(shown), 0.0, 1.0));
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return grey;
  TexelEdges edges = texelEdges(texel, receiver);
  float area = max(abs(edges.u.x * edges.v.y - edges.u.y * edges.v.x), 1e-30);
  vec2 width = vec2(length(edges.v), length(edges.u)) * (abs(edges.scale) / area);
  float lightSquares = checkerboard(texel.coordinate.xy * atlasTexels, max(width, vec2(0.02)));
  return grey * kTints[texel.tile] * mix(0.3, 1.0, lightSquares);
}
#endif

#ifdef ENCODED
#include "common_names.glsl"
#include "shared/heat_map.h"
#endif

#ifdef VIEW_TEXEL_DENSITY
// The largest extent in pixels of the texel under the point: the greater singular value of its two edges. (Lloyd et al.,
// "Logarithmic Perspective Shadow Maps", 2008: the aliasing error m.) Kept to what 16 bits of an EXR can hold.
float texelDensity(DebugTexel texel, Receiver receiver) {
  TexelEdges edges = texelEdges(texel, receiver);
  float uu = dot(edges.u, edges.u);
  float vv = dot(edges.v, edges.v);
  float uv = dot(edges.u, edges.v);
  float greatest = sqrt(0.5 * (uu + vv + sqrt((uu - vv) * (uu - vv) + 4.0 * uv * uv)));
  return min(greatest / max(abs(edges.scale), 1e-30), 65504.0);
}

vec4 debugData(Receiver receiver) {
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return vec4(0.0);
  float density = texelDensity(texel, receiver);
#ifdef ENCODED
  return vec4(heat(0.5 + log2(density) / 8.0), 1.0);
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
  vec3 last = texel.data.atlasFromRelative[3].xyz;
  mat3 planes = mat3(texel.data.atlasFromRelative[0].xyz - at.coordinate.x * last,
                     texel.data.atlasFromRelative[1].xyz - at.coordinate.y * last,
                     texel.data.atlasFromRelative[2].xyz - at.coordinate.z * last);
  return length(inverse(transpose(planes)) * ((at.coordinate - texel.coordinate) * texel.divisor));
}

vec4 debugData(Receiver receiver) {
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return vec4(0.0);
  float metres = biasMetres(texel, receiver);
#ifdef ENCODED
  const float decades = 1.0 / log2(10.0);
  return vec4(heat(1.0 + 0.25 * decades * log2(max(metres, 1e-9))), 1.0);
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

// A hue for each index, far from those of its neighbours: steps of the golden ratio.
vec3 nodeColor(int node) {
  vec3 steps = fract(float(node + 1) * vec3(0.61803399, 0.75487767, 0.56984029));
  vec3 hue = clamp(abs(fract(steps.x + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
  return mix(vec3(1.0), hue, 0.55 + 0.4 * steps.y) * (0.7 + 0.3 * steps.z);
}

vec4 debugData(Receiver receiver) {
  int node = casterNode(receiver);
#ifdef ENCODED
  vec3 toEye = frame.perspective != 0u ? -normalize(receiver.relative) : -frame.forward;
  vec3 lit = vec3(0.25 + 0.35 * abs(dot(receiver.normal, toEye)));
  return vec4(node < 0 ? lit : nodeColor(node), 1.0);
#else
  return vec4(float(node));
#endif
}
#endif
