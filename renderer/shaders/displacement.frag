#include "shared/frame_types.h"
#define TEXEL_EDGES
#include "common_surface.glsl"
#include "common_surface_read.glsl"
#include "common_shadow.glsl"
#include "common_names.glsl"
#include "shared/light.h"
#include "common_debug.glsl"

// What a shadow map does to an edge that runs through a pixel: its texel as it lies on the surface, and where the bias has
// the point looked up (renderer/shadow/predicted_error.h). Pixels, y up; view depth 0 where the light reaches no
// surface that receives its shadow.
layout(location = 0) out uvec4 lengths; // shift, texel u and texel v as two halves each; tile of the light
layout(location = 1) out uvec4 place;   // view depth; octahedral normal; radius of the penumbra, texels

uint halves(vec2 pixels) { return packHalf2x16(clamp(pixels, -kMostPixels, kMostPixels)); }

#ifdef FILTER_PCSS
float penumbraTexels(Receiver receiver, TileData tile, vec3 toLight) {
  LightData light = lights[debugLight];
  Lookup at = lookupIn(light, tile, receiver, toLight);
  if (light.filterKind != GNOMON_FILTER_PCSS || !at.inside) return 0.0;
  return texelsAcross(tile, max(penumbraRadius(light, tile, at, comparedSlope(light, tile, receiver.relative, receiver.normal)), 0.0));
}
#endif

void main() {
  lengths = uvec4(0u);
  place = uvec4(0u);
  Sample seen = sampleAt(0);
  if (!seen.hit) return;
  Receiver receiver;
  receiver.relative = seen.relative;
  receiver.normal = unpackedSurface(seen.bits).face;
  receiver.viewDepth = seen.viewDepth;
#ifdef SMOOTH_PLACES
  receiver.sampleIndex = seen.index;
  receiver.lifted = false;
#endif
#ifdef RECEIVER_GROUPS
  receiver.groupBit = 1u << receiverGroup(seen.bits);
  if ((lights[debugLight].litGroups & lights[debugLight].shadowedGroups & receiver.groupBit) == 0u) return;
#endif
  vec3 toLight;
  vec3 arriving = irradiance(lights[debugLight], receiver.relative, toLight);
  receiver = shadedReceiver(lights[debugLight], receiver, toLight);
  if (arriving == vec3(0.0) || isTurnedAway(receiver, toLight)) return;
  place = uvec4(floatBitsToUint(seen.viewDepth), seen.bits.x, 0u, 0u);
  DebugTexel texel = debugTexel(receiver);
  if (!texel.found) return;
  TexelEdges edges = texelEdges(texel, receiver);
  float scale = edgeScale(edges);
  vec3 shift = shiftOnSurface(lights[debugLight], texel.data, receiver.relative, receiver.normal, toLight);
  lengths = uvec4(halves(pixelsAlong(receiver, shift)), halves(edges.u / scale), halves(edges.v / scale),
                  uint(texel.tile));
#ifdef FILTER_PCSS
  place.z = floatBitsToUint(penumbraTexels(receiver, texel.data, toLight));
#endif
}
