// Where a receiver lies in a light's tiles.
#include "common_names.glsl"
#include "shared/shadow_bias.h"
#ifdef LIGHT_COUNT
// Loops over them may be unrolled, and of an array without a length NVIDIA's driver 580 reads zeros at a constant place
// past the first.
layout(std430, binding = GNOMON_LIGHT_BUFFER) readonly buffer LightBuffer { LightData lights[LIGHT_COUNT]; };
#else
layout(std430, binding = GNOMON_LIGHT_BUFFER) readonly buffer LightBuffer { LightData lights[]; };
#endif
layout(std430, binding = GNOMON_TILE_BUFFER) readonly buffer TileBuffer { TileData tiles[]; };

struct Receiver {
  vec3 relative;
  vec3 normal;     // of the surface itself, not of its shading; unit length
  float viewDepth; // metres
#ifdef SMOOTH_PLACES
  int sampleIndex; // of the pixel
  bool lifted;     // to the surface that shading shows: as shadedReceiver gives it
#endif
#ifdef RECEIVER_GROUPS
  uint groupBit;
#endif
#if defined(VISIBILITY_LAYERS) || defined(BAKED_LIGHTS) || defined(SKY_SHADOW)
  uint samples; // of the pixel that show it, a bit each
#endif
};

#ifdef SMOOTH_PLACES
#include "shared/smooth_surface.h"

// A receiver as its shadow is looked up: where its triangle leaves some of the light behind its plane, the curved surface
// that shading shows takes its place, if that faces more of the light.
Receiver shadedReceiver(LightData light, Receiver receiver, vec3 toLight) {
  if (light.smoothTerminator == 0u) return receiver;
  float cosine = dot(receiver.normal, toLight);
  if (cosine > wholeLightCosine(light, receiver.relative)) return receiver;
  uvec2 place = texelFetch(surfaceSmooth, ivec2(gl_FragCoord.xy), receiver.sampleIndex).xy;
  float height = uintBitsToFloat(place.y);
  vec3 normal = fromOctahedral(unpackSnorm2x16(place.x));
  if (height < 0.0 || smoothGain(cosine, dot(normal, toLight)) <= 0.0) return receiver;
  receiver.relative += normal * height;
  receiver.normal = normal;
  receiver.lifted = true;
  return receiver;
}

vec3 towards(LightData light, Receiver receiver) {
#ifdef PUNCTUAL
  if (light.type != GNOMON_DIRECTIONAL) return normalize(light.position - receiver.relative);
#endif
  return light.direction;
}
#else
#define shadedReceiver(light, receiver, toLight) (receiver)
#endif

// Where in the atlas a receiver is looked up in one tile.
struct Lookup {
  vec3 coordinate; // atlas u v, depth less its bias
  float divisor;   // metres from the light along the tile's axis; 1 for parallel light
  bool inside;     // of what the tile covers; outside everything is lit
};

Lookup lookupIn(LightData light, TileData tile, Receiver receiver, vec3 toLight) {
  vec4 p = vec4(movedReceiver(light, tile, receiver.relative, receiver.normal, toLight), 1.0);
  Lookup at;
  at.coordinate = vec3(dot(tile.atlasFromRelative[0], p), dot(tile.atlasFromRelative[1], p),
                       dot(tile.atlasFromRelative[2], p));
  at.divisor = 1.0;
  at.inside = true;
#ifdef PUNCTUAL
  at.divisor = dot(tile.atlasFromRelative[3], p);
  if (at.divisor <= 0.0) return Lookup(vec3(0.0), 1.0, false);
  at.coordinate /= at.divisor;
  at.coordinate.z -= tile.depthBias + tile.depthBiasNear / (at.divisor * at.divisor);
#else
  at.coordinate.z -= tile.depthBias;
#endif
#ifdef SMOOTH_PLACES
  // Tiles have room for what is in view, not for how far it is lifted: what leaves one so is looked up at its rim, and
  // just behind the casters that are drawn with their depth clamped.
  if (receiver.lifted) {
    at.coordinate = vec3(clamp(at.coordinate.xy, tile.lowest, tile.highest), max(at.coordinate.z, 1e-6));
  }
#endif
  if (any(lessThan(at.coordinate.xy, tile.lowest)) || any(greaterThan(at.coordinate.xy, tile.highest))) {
    at.inside = false;
  }
  return at;
}
