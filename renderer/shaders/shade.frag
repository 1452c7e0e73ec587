#define FRAGMENT_STAGE
#include "shared/frame_types.h"
#include "common_surface_varyings.glsl"
#include "common_brdf.glsl"
#include "common_material.glsl"
#include "common_shadow.glsl"
#include "common_tone.glsl"

layout(std140, binding = GNOMON_FRAME_BUFFER) uniform FrameBuffer { FrameData frame; };
layout(location = 0) out vec4 target;

// Irradiance on a surface that faces the light, and where the light is.
// Range and cone as in KHR_lights_punctual.
vec3 irradiance(LightData light, vec3 relative, out vec3 toLight) {
  int type = int(light.direction.w);
  if (type == GNOMON_DIRECTIONAL) {
    toLight = light.direction.xyz;
    return light.radiance.rgb;
  }
#ifdef PUNCTUAL
  vec3 offset = light.position.xyz - relative;
  float squared = max(dot(offset, offset), 1e-8);
  toLight = offset * inversesqrt(squared);
  float attenuation = 1.0 / squared;
  if (light.position.w > 0.0) {
    float ratio = squared / (light.position.w * light.position.w);
    attenuation *= clamp(1.0 - ratio * ratio, 0.0, 1.0);
  }
  if (type == GNOMON_SPOT) {
    float falloff = clamp(dot(light.direction.xyz, -toLight) * light.cone.x + light.cone.y, 0.0, 1.0);
    attenuation *= falloff * falloff;
  }
  return light.radiance.rgb * attenuation;
#else
  return vec3(0.0);
#endif
}

vec3 radianceToEye(SurfacePoint s, Receiver receiver) {
  vec3 sum = s.emission + frame.ambient.rgb * ambientReflectance(s) * s.occlusion;
  for (int i = 0; i < LIGHT_COUNT; ++i) {
    vec3 toLight;
    vec3 arriving = irradiance(lights[i], receiver.relative, toLight);
    vec3 reflected = reflectedRadiance(s, toLight) * arriving;
    sum += reflected * shadowVisibility(i, receiver, toLight, reflected != vec3(0.0));
  }
  return sum;
}

int firstShadowed() {
  for (int i = 0; i < LIGHT_COUNT; ++i) {
    if (lights[i].tiles.x > 0u) return i;
  }
  return -1;
}

void main() {
  // The pixel's centre: at an edge it may lie just off the surface, in its plane. (A centroid would lie on it, but on
  // llvmpipe centroid positions were found to be far enough off the plane for a dark line along every edge.)
  vec3 relative = surface.relative;
  float viewDepth = dot(relative, frame.forward.xyz);
  vec3 toEye = frame.forward.w > 0.0 ? -normalize(relative) : -frame.forward.xyz;
  MaterialData material = materials[materialIndex];
  vec3 face = faceNormal(toEye);
  vec4 color = baseColor(material);
#ifdef ALPHA_MASK
  if (color.a < material.emissiveFactor.w) discard;
#endif
  Receiver receiver = Receiver(relative, face, viewDepth);

#if defined(VIEW_COLOR) || defined(VIEW_CASCADES)
  SurfacePoint s = surfacePoint(material, color, face, toEye);
  vec3 shown = toneMapped(radianceToEye(s, receiver) * frame.depthRange.z);
#ifdef VIEW_CASCADES
  int tinted = firstShadowed();
  if (tinted >= 0) shown = dot(shown, vec3(0.2126, 0.7152, 0.0722)) * cascadeTint(tinted, viewDepth);
#endif
  target = vec4(shown, 1.0);
#elif defined(VIEW_DEPTH)
#ifdef ENCODED
  float span = max(frame.depthRange.y - frame.depthRange.x, 1e-6);
  target = vec4(vec3(1.0 - 0.9 * clamp((viewDepth - frame.depthRange.x) / span, 0.0, 1.0)), 1.0);
#else
  target = vec4(viewDepth);
#endif
#elif defined(VIEW_NORMAL)
  vec3 n = shadingNormal(material, face);
#ifdef ENCODED
  n = n * 0.5 + 0.5;
#endif
  target = vec4(n, 1.0);
#elif defined(VIEW_SHADOW)
  int shadowed = firstShadowed();
  float visibility = 1.0;
  if (shadowed >= 0) {
    vec3 toLight;
    irradiance(lights[shadowed], relative, toLight);
    visibility = shadowVisibility(shadowed, receiver, toLight, true);
  }
  target = vec4(vec3(visibility), 1.0);
#endif
}
