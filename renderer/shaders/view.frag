#include "shared/frame_types.h"
#include "common_surface.glsl"
#include "common_surface_read.glsl"
#include "common_names.glsl"
#define ENVIRONMENT_UNIT GNOMON_ENVIRONMENT_UNIT
#include "common_environment.glsl"
#include "common_shadow.glsl"
#include "shared/light.h"
#include "common_light_lists.glsl"
#include "common_sky_share.glsl"
#include "shared/picture.h"
#include "shared/shadow_catcher.h"
#ifdef DEBUG_LIGHT
#include "common_debug.glsl"
#endif

layout(location = 0) out vec4 target;

vec3 radianceFrom(int light, SurfacePoint s, Receiver receiver) {
#ifdef RECEIVER_GROUPS
  if ((lights[light].litGroups & receiver.groupBit) == 0u) return vec3(0.0);
#endif
  vec3 toLight;
  vec3 arriving = irradiance(lights[light], receiver.relative, toLight);
  vec3 reflected = reflectedRadiance(s, toLight) * arriving;
  float visibility = shadowVisibility(light, receiver, toLight, reflected != vec3(0.0));
#ifdef SHADOW_COLOR
  return reflected * mix(lights[light].shadowColor, vec3(1.0), visibility);
#else
  return reflected * visibility;
#endif
}

bool isUnlit(vec4 emission) {
#ifdef UNLIT
  return emission.w == 1.0;
#else
  return false;
#endif
}

// What a surface shows of the surroundings. `arriving`: what the scene leaves of their light, as environmentReflected
// has it.
vec3 reflectedSurroundings(Surface surface, SurfacePoint s, vec4 arriving) {
#ifdef ENVIRONMENT
  vec3 reflected = environmentReflected(environmentTexels, frame.environmentTurn, s, surface.baseColor, surface.metallic,
                                        surface.roughness, surface.face, arriving);
  return frame.environmentIntensity * reflected;
#else
  return frame.ambient * studioReflected(frame.environmentTurn, frame.studioLamps, s, surface.baseColor, surface.metallic,
                                         surface.roughness, surface.face, arriving);
#endif
}

vec3 radianceToEye(Surface surface, SurfacePoint s, Receiver receiver, vec4 emission) {
#ifdef VIEW_LIGHT_CONTRIBUTION
  return isUnlit(emission) || debugLight < 0 ? vec3(0.0) : radianceFrom(debugLight, s, receiver);
#else
  if (isUnlit(emission)) return emission.rgb;
#ifdef SKY_SHADOW
  vec4 arriving = skyShare(receiver.samples);
#else
  vec4 arriving = vec4(1.0);
#endif
  vec3 sum = emission.rgb + reflectedSurroundings(surface, s, arriving) * surface.occlusion;
  uvec2 list = lightList();
  for (uint k = list.x; k < list.y; ++k) sum += radianceFrom(listedLight(k), s, receiver);
  return sum;
#endif
}

// `samples`: those of the pixel that show it, a bit each.
Receiver receiverOf(Sample seen, vec3 face, uint samples) {
  Receiver receiver;
  receiver.relative = seen.relative;
  receiver.normal = face;
  receiver.viewDepth = seen.viewDepth;
#ifdef SMOOTH_PLACES
  receiver.sampleIndex = seen.index;
  receiver.lifted = false;
#endif
#ifdef RECEIVER_GROUPS
  receiver.groupBit = 1u << receiverGroup(seen.bits);
#endif
#if defined(VISIBILITY_LAYERS) || defined(BAKED_LIGHTS) || defined(SKY_SHADOW)
  receiver.samples = samples;
#endif
  return receiver;
}

#ifdef VOLUMES
// rgb: what volumes send; a: the share of the light behind them that they let through.
layout(binding = GNOMON_VOLUMES_UNIT) uniform sampler2D volumes;
vec4 volumesHere() { return texelFetch(volumes, ivec2(gl_FragCoord.xy), 0); }
#endif

#ifndef TONE
#define TONE GNOMON_TONE_NONE
#endif

vec4 shownColor(SeenLight seen) {
#ifdef VOLUMES
  vec4 before = volumesHere();
  seen = seenBehind(seen, before.rgb, before.a);
#endif
  return vec4(shownColor(seen, frame.exposureScale, TONE), seen.alpha);
}

#ifdef SHOWN_SURROUNDINGS
// Where the line of sight through the pixel's centre goes. Unit length.
vec3 sightAway() {
  vec2 ndc = gl_FragCoord.xy * frame.pixelStep - 1.0;
  vec3 across = frame.right * ndc.x + frame.up * ndc.y;
  return normalize(frame.perspective != 0u ? frame.middle + across : frame.middle);
}
#endif

SeenLight backgroundLight() {
#ifdef VIEW_LIGHT_CONTRIBUTION
  return seenLight(vec3(0.0), vec3(0.0), frame.background.a);
#elif defined(SHOWN_SURROUNDINGS)
  return seenLight(radianceOfSurroundings(sightAway(), frame.shownRoughness), vec3(0.0), 1.0);
#else
  return seenLight(vec3(0.0), frame.background.rgb, frame.background.a);
#endif
}

#ifdef CATCHER
bool isCatcher(vec4 emission) { return emission.w == 2.0; }

CaughtLight caughtOf(int light, vec3 normal, Receiver receiver) {
#ifdef RECEIVER_GROUPS
  if ((lights[light].litGroups & receiver.groupBit) == 0u) return caughtLight(0.0, 0.0);
#endif
  vec3 toLight;
  vec3 arriving = irradiance(lights[light], receiver.relative, toLight);
  bool shines = dot(normal, toLight) > 0.0 && arriving != vec3(0.0);
  vec3 left = vec3(shadowVisibility(light, receiver, toLight, shines));
#ifdef SHADOW_COLOR
  left = mix(lights[light].shadowColor, vec3(1.0), left);
#endif
  return caughtFrom(normal, toLight, arriving, left);
}

CaughtLight caughtHere(vec3 normal, Receiver receiver) {
  vec3 open = vec3(1.0);
#ifdef SKY_SHADOW
  open = skyShare(receiver.samples).rgb;
#endif
  CaughtLight sum = caughtAround(irradianceOfSurroundings(normal), open);
  uvec2 list = lightList();
  for (uint k = list.x; k < list.y; ++k) {
    CaughtLight one = caughtOf(listedLight(k), normal, receiver);
    sum.all += one.all;
    sum.lost += one.lost;
  }
  return sum;
}
#endif

SeenLight surfaceLight(Surface surface, Sample seen, Receiver receiver) {
  vec3 toEye = frame.perspective != 0u ? -normalize(seen.relative) : -frame.forward;
  SurfacePoint s = surfacePoint(surface.baseColor, surface.metallic, surface.roughness, surface.normal, toEye);
  vec4 emission = emissionAt(seen.index);
#ifdef CATCHER
  if (isCatcher(emission)) return seenThroughCatcher(backgroundLight(), caughtHere(surface.normal, receiver));
#endif
  vec3 radiance = radianceToEye(surface, s, receiver, emission);
  return isUnlit(emission) ? seenLight(vec3(0.0), radiance, 1.0) : seenLight(radiance, vec3(0.0), 1.0);
}

vec4 picture(Sample seen, uint samples) {
  if (!seen.hit) return shownColor(backgroundLight());
  Surface surface = unpackedSurface(seen.bits);
  Receiver receiver = receiverOf(seen, surface.face, samples);
  vec4 shown = shownColor(surfaceLight(surface, seen, receiver));
#if defined(VIEW_CASCADES)
  vec3 tint = hasTiles() ? cascadeTint(debugLight, receiver, towardsDebugLight(receiver)) : vec3(1.0);
  shown.rgb = luminance(shown.rgb) * tint;
#elif defined(VIEW_TEXEL_GRID)
  shown.rgb = texelGrid(shown.rgb, receiver);
#endif
  return shown;
}

#if SAMPLES > 1
#ifdef CATCHER
// Colors count as much as they cover.
vec4 addend(vec4 shown) { return vec4(shown.rgb * shown.a, shown.a); }
vec4 meanOf(vec4 sum) {
  vec4 mean = sum / float(SAMPLES);
  return mean.a > 0.0 ? vec4(mean.rgb / mean.a, mean.a) : shownColor(backgroundLight());
}
#else
vec4 addend(vec4 shown) { return shown; }
vec4 meanOf(vec4 sum) { return sum / float(SAMPLES); }
#endif

// The mean of the pixel's samples; those that show one surface are lit once. The loop turns once for each surface, so
// that a pixel inside one costs no more than without antialiasing.
vec4 antialiased() {
  vec4 sum = vec4(0.0);
  uint left = (1u << SAMPLES) - 1u;
  while (left != 0u) {
    uint same;
    Sample seen = mergedSample(left, same);
    left &= ~same;
    sum += float(bitCount(same)) * addend(picture(seen, same));
  }
  return meanOf(sum);
}
#else
vec4 antialiased() { return picture(sampleAt(0), 1u); }
#endif

#if defined(VIEW_COLOR) || defined(VIEW_CASCADES) || defined(VIEW_TEXEL_GRID) || defined(VIEW_LIGHT_CONTRIBUTION)
void main() { target = antialiased(); }
#else
vec4 background() {
#if defined(VIEW_DEPTH) && !defined(ENCODED)
  return vec4(uintBitsToFloat(0x7f800000u)); // infinity
#elif defined(VIEW_SHADOW)
#ifdef VISIBILITY_LAYERS
  // At the rim of a surface a ray may meet what no pixel's centre shows.
  bool traced = debugLight >= 0 && lights[debugLight].visibilityLayer > 0u &&
                lights[debugLight].layerOmitsTurnedFaces == 0u;
  if (traced) return vec4(vec3(mix(1.0, layerValue(debugLight, 1u), lights[debugLight].strength)), 1.0);
#endif
  return vec4(1.0);
#elif defined(VIEW_CASTER_IDS) && !defined(ENCODED)
  return vec4(-1.0);
#else
  return vec4(0.0);
#endif
}

vec4 data(Sample seen) {
#if defined(VIEW_DEPTH)
#ifdef ENCODED
  float span = max(frame.farthest - frame.nearest, 1e-6);
  return vec4(vec3(1.0 - 0.9 * clamp((seen.viewDepth - frame.nearest) / span, 0.0, 1.0)), 1.0);
#else
  return vec4(seen.viewDepth + frame.ahead);
#endif
#elif defined(VIEW_NORMAL)
  vec3 n = unpackedSurface(seen.bits).normal;
#ifdef ENCODED
  n = n * 0.5 + 0.5;
#endif
  return vec4(n, 1.0);
#elif defined(VIEW_ALBEDO)
  vec4 glow = emissionAt(seen.index); // what is unlit emits its color
  return vec4(glow.w == 1.0 ? glow.rgb : unpackedSurface(seen.bits).baseColor, 1.0);
#else
  Receiver receiver = receiverOf(seen, unpackedSurface(seen.bits).face, 1u);
#if defined(VIEW_SHADOW) && defined(SKY_SHADOW)
  return vec4(vec3(luminance(skyShare(1u).rgb)), 1.0);
#elif defined(VIEW_SHADOW)
  if (debugLight < 0) return vec4(1.0);
  return vec4(vec3(shadowVisibility(debugLight, receiver, towardsDebugLight(receiver), true)), 1.0);
#elif defined(DEBUG_LIGHT)
  return debugData(receiver);
#else
  return vec4(0.0);
#endif
#endif
}

void main() {
  Sample seen = sampleAt(0);
  target = seen.hit ? data(seen) : background();
}
#endif
