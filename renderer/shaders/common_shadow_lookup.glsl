// Where a receiver lies in a light's tiles.
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
#if defined(VISIBILITY_LAYERS) || defined(BAKED_LIGHTS)
  uint samples; // of the pixel that show it, a bit each
#endif
};

#ifdef SMOOTH_PLACES
#include "shared/smooth_surface.h"

// A receiver as its shadow is looked up: where its triangle leaves some of the light behind its plane, the curved surface
// that shading shows takes its place, if that faces more of the light.
Receiver shadedReceiver(LightData light, Receiver receiver, vec3 toLight) {
  if (light.smoothTerminator == 0u) return receiver;
  float whole = 1e-4; // as isTurnedAway
#ifdef FILTER_PCSS
  if (light.filterKind == GNOMON_FILTER_PCSS) {
    float distance = light.type == GNOMON_DIRECTIONAL ? 1.0 : length(light.position - receiver.relative);
    whole = max(whole, light.filterRadius / distance);
  }
#endif
  float cosine = dot(receiver.normal, toLight);
  if (cosine > whole) return receiver;
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

// The receiver, moved so that its surface doesn't shadow itself: automatically along its normal by
// reach * sin(angle) (see renderer/shadow/filter_kernel.h), or as the light's own bias says.
vec3 movedReceiver(LightData light, TileData tile, Receiver receiver, vec3 toLight) {
#ifdef MANUAL_BIAS
  if (light.hasManualBias != 0u) {
    float cosine = clamp(dot(receiver.normal, toLight), 1e-2, 1.0);
    float tangent = sqrt(1.0 - cosine * cosine) / cosine;
    return receiver.relative + receiver.normal * light.manualNormalOffset +
           toLight * (light.manualDepthBias + light.manualSlopeBias * tangent);
  }
#endif
  float cosine = dot(receiver.normal, tile.axis);
  float offset = tile.normalOffset * sqrt(max(1.0 - cosine * cosine, 0.0));
#ifdef PUNCTUAL
  offset *= dot(tile.atlasFromRelative[3], vec4(receiver.relative, 1.0));
#endif
  return receiver.relative + receiver.normal * offset;
}

Lookup lookupIn(LightData light, TileData tile, Receiver receiver, vec3 toLight) {
  vec4 p = vec4(movedReceiver(light, tile, receiver, toLight), 1.0);
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

bool isParallel(TileData tile) {
#ifdef PUNCTUAL
  return dot(tile.atlasFromRelative[3].xyz, tile.axis) == 0.0;
#else
  return true;
#endif
}

// How the tile's depth changes on the receiver's plane with each texel.
vec2 receiverSlope(TileData tile, Receiver receiver, vec3 lightPosition) {
  vec2 across = vec2(dot(receiver.normal, tile.right), dot(receiver.normal, tile.up));
  if (isParallel(tile)) return across / -min(dot(receiver.normal, tile.axis), -1e-4);
  // z is a line in 1 / distance, and so is 1 / distance in the tangents of a plane.
  return across / min(dot(receiver.normal, receiver.relative - lightPosition), -1e-6);
}

// The slope that comparisons follow: none where the light's own bias says all.
vec2 comparedSlope(LightData light, TileData tile, Receiver receiver) {
#ifdef MANUAL_BIAS
  if (light.hasManualBias != 0u) return vec2(0.0);
#endif
  return receiverSlope(tile, receiver, light.position);
}

// By how much a surface may rise over the receiver's plane within a texel and not shadow it, z: where it bends by up to
// kBendAngle radians, but no more than the plane itself rises on kBendTexels; and what a normal of 16 bits an axis may lean
// on the way to the farthest texel, `reach` away, which is more where the light all but grazes the surface.
const float kBendAngle = 0.1;
const float kBendTexels = 0.3;
const float kNormalRounding = 2e-4;

float bendRoom(LightData light, TileData tile, Lookup at, vec2 slope, float reach) {
#ifdef MANUAL_BIAS
  if (light.hasManualBias != 0u) return 0.0;
#endif
  // With the depth that a texel's width is worth: tan(a + bend) - tan(a) is about bend (1 + tan(a)^2).
  float texel = tile.texelDepth / at.divisor;
  float bent = texel + dot(slope, slope) / max(texel, 1e-30);
  float most = kBendTexels * (texel + abs(slope.x) + abs(slope.y));
  return max(min(kBendAngle * bent, most), kNormalRounding * reach * bent);
}
