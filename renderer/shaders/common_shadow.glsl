// Visibility of a light through its tiles in the shadow atlas.
#include "common_shadow_lookup.glsl"
#include "common_shadow_filter.glsl"
#include "common_shadow_disc.glsl"
#include "common_shadow_choice.glsl"

// Share of the light that one tile lets through; 1 outside of what the tile covers. The bounds leave the filter room:
// no lookup of it leaves the tile.
float tileVisibility(LightData light, TileData tile, Receiver receiver, vec3 toLight) {
  Lookup at = lookupIn(light, tile, receiver, toLight);
  if (!at.inside) return 1.0;
#ifdef FILTER_KIND
  const int kind = FILTER_KIND; // all lights have the same
#else
  int kind = light.filterKind;
#endif
  vec2 slope = comparedSlope(light, tile, receiver.relative, receiver.normal);
#ifdef FILTER_MOMENTS
  if (GNOMON_READS_MOMENTS(kind)) return momentVisibility(at.coordinate.xy, momentDepth(tile, at.coordinate.z, at.divisor), kind);
#endif
#ifdef FILTER_DISC
  if (kind == GNOMON_FILTER_DISC) {
    at.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0 + texelsAcross(tile, light.filterRadius) / at.divisor);
    return discVisibility(tile, at, slope, discRadius(tile, light.filterRadius, at.divisor), kWholeDisc);
  }
#endif
#ifdef FILTER_PCSS
  if (kind == GNOMON_FILTER_PCSS) {
    return pcssVisibility(light, tile, at, slope) * shareAbovePlane(light, receiver.relative, receiver.normal, toLight);
  }
#endif
#ifdef FILTER_SIZE
  const int size = FILTER_SIZE; // all lights have the same
#else
  int size = light.filterSize;
#endif
  at.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 0.5 * float(size + 1));
  return kernelVisibility(at.coordinate.xy * atlasTexelCount(), PlaneDepths(at.coordinate.z, slope), size);
}

bool isTurnedAway(Receiver receiver, vec3 toLight) { return dot(receiver.normal, toLight) <= kTurnedAway; }

#ifdef VISIBILITY_LAYERS
// What rays or shadow volumes say: a layer a light, a channel a sample of the pixel.
layout(binding = GNOMON_VISIBILITY_UNIT) uniform sampler2DArray visibilityLayers;

// The mean over `samples` of the pixel, a bit each.
float layerMean(int layer, uint samples) {
  vec4 seen = texelFetch(visibilityLayers, ivec3(gl_FragCoord.xy, layer), 0);
#if SAMPLES > 1
  uvec4 bits = (uvec4(samples) >> uvec4(0u, 1u, 2u, 3u)) & 1u;
  return dot(seen, vec4(bits)) / float(bitCount(samples));
#else
  return seen.r;
#endif
}

#endif

#ifdef BAKED_LIGHTS
// What light maps say: a channel a light, of those whose layers' numbers are higher than FIRST_BAKED.
layout(binding = GNOMON_BAKED_UNIT) uniform SURFACE_FLOATS bakedShares;

float bakedMean(uint channel, uint samples) {
#if SAMPLES > 1
  float sum = 0.0;
  for (int i = 0; i < SAMPLES; ++i) {
    if ((samples & (1u << i)) != 0u) sum += texelFetch(bakedShares, ivec2(gl_FragCoord.xy), i)[channel];
  }
  return sum / float(bitCount(samples));
#else
  return texelFetch(bakedShares, ivec2(gl_FragCoord.xy), 0)[channel];
#endif
}
#endif

#if defined(VISIBILITY_LAYERS) || defined(BAKED_LIGHTS)
float layerValue(int light, uint samples) {
  uint layer = lights[light].visibilityLayer - 1u;
#ifdef BAKED_LIGHTS
  if (layer >= FIRST_BAKED) return bakedMean(layer - FIRST_BAKED, samples);
#endif
#ifdef VISIBILITY_LAYERS
  return layerMean(int(layer), samples);
#else
  return 1.0;
#endif
}

float layerVisibility(int light, Receiver receiver, vec3 toLight) {
#ifdef RECEIVER_GROUPS
  if ((lights[light].shadowedGroups & receiver.groupBit) == 0u) return 1.0;
#endif
  float visibility = layerValue(light, receiver.samples);
  // Rays know which faces are turned away, shadow volumes don't.
  if (lights[light].layerOmitsTurnedFaces != 0u && isTurnedAway(receiver, toLight)) visibility = 0.0;
  return mix(1.0, visibility, lights[light].strength);
}
#endif

float surfaceVisibility(int light, Receiver receiver, vec3 toLight, bool needed) {
#if defined(VISIBILITY_LAYERS) || defined(BAKED_LIGHTS)
  if (lights[light].visibilityLayer > 0u) return layerVisibility(light, receiver, toLight);
#endif
#ifdef NO_SHADOWS
  return 1.0;
#endif
  if (lights[light].tileCount == 0u) return 1.0;
#ifdef RECEIVER_GROUPS
  if ((lights[light].shadowedGroups & receiver.groupBit) == 0u) return 1.0;
#endif
#ifdef SMOOTH_PLACES
  receiver = shadedReceiver(lights[light], receiver, toLight);
  toLight = towards(lights[light], receiver);
#endif
  TileChoice choice = chooseTile(light, receiver, toLight);
  if (!choice.covered) return 1.0;
  float strength = lights[light].strength;
  bool turnedAway = isTurnedAway(receiver, toLight);
  float visibility = 0.0;
  for (int i = choice.first; i <= choice.second && needed && !turnedAway; ++i) {
    float share = i == choice.first ? 1.0 - choice.blend : choice.blend;
    visibility += share * tileVisibility(lights[light], tiles[lights[light].firstTile + i], receiver, toLight);
  }
  visibility = mix(visibility, 1.0, choice.fade);
  return mix(1.0, visibility, strength);
}

// `needed` false spares the lookups where no light arrives anyway.
float shadowVisibility(int light, Receiver receiver, vec3 toLight, bool needed) {
  float visibility = surfaceVisibility(light, receiver, toLight, needed);
#ifdef VOLUME_LIGHT
#ifdef RECEIVER_GROUPS
  bool receives = (lights[light].shadowedGroups & receiver.groupBit) != 0u;
#else
  const bool receives = true;
#endif
  // What volumes let through of it, the last layer: both are shadow, of one strength.
  if (light == VOLUME_LIGHT && receives) {
    float left = 1.0 - lights[light].strength;
    float share = layerMean(textureSize(visibilityLayers, 0).z - 1, receiver.samples);
    visibility = left + (visibility - left) * share;
  }
#endif
  return visibility;
}

// The cascades from near to far, or a light's faces; white beyond.
const vec3 kTints[8] = vec3[8](GNOMON_TINTS_0_3, GNOMON_TINTS_4_7);

vec3 cascadeTint(int light, Receiver receiver, vec3 toLight) {
  TileChoice choice = chooseTile(light, receiver, toLight);
  if (!choice.covered) return vec3(1.0);
  return mix(mix(kTints[choice.first], kTints[choice.second], choice.blend), vec3(1.0), choice.fade);
}
