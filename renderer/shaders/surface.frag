#define FRAGMENT_STAGE
#ifdef SHOWN_SAMPLES
#extension GL_ARB_post_depth_coverage : enable
#ifdef GL_ARB_post_depth_coverage
layout(post_depth_coverage) in;
#endif
#endif
#include "shared/frame_types.h"
#include "common_surface_varyings.glsl"
#include "common_surface.glsl"
#include "common_names.glsl"
#include "shared/normal_map.h"
#include "shared/specular_glossiness.h"
#include "shared/smooth_surface.h"
#include "common_material.glsl"
#if defined(ALPHA_MASK) && defined(BASE_COLOR_TEXTURE)
#include "common_mask_coverage.glsl"
#endif

layout(std140, binding = GNOMON_FRAME_BUFFER) uniform FrameBuffer { FrameData frame; };
#ifdef TRANSMISSION
#define ENVIRONMENT_UNIT GNOMON_SURFACE_ENVIRONMENT_UNIT
#include "common_environment.glsl"
#endif
layout(location = 0) out uvec4 surfaceBits;
#ifdef EMISSION
layout(location = 1) out vec4 emitted;
#endif
#ifdef TRIANGLE_NUMBERS
layout(location = TRIANGLE_NUMBERS) out uint triangleNumber;
#endif
#ifdef SMOOTH_PLACES
layout(location = SMOOTH_PLACES) out uvec2 smoothPlace;
#endif
#ifdef BAKED_LIGHTS
layout(location = BAKED_SHARES) out vec4 bakedShares; // a channel a light
layout(binding = GNOMON_LIGHT_MAP_UNIT) uniform sampler2D lightMaps[BAKED_LIGHTS];
#endif

#ifdef SHOWN_SAMPLES
layout(location = GNOMON_SAMPLE_POSITIONS) uniform vec2 samplePositions[SHOWN_SAMPLES];
#endif

#if defined(SHOWN_SAMPLES) && defined(GL_ARB_post_depth_coverage)
// In the middle of the samples that show the triangle: the others may lie in another surface's shadow.
vec2 placeInMaps() {
  vec2 sum = vec2(0.0);
  int count = 0;
  for (int i = 0; i < SHOWN_SAMPLES; ++i) {
    if ((gl_SampleMaskIn[0] & (1 << i)) == 0) continue;
    sum += samplePositions[i];
    ++count;
  }
  vec2 off = sum / float(max(count, 1)) - vec2(0.5);
  return surface.mapPlace + dFdx(surface.mapPlace) * off.x + dFdy(surface.mapPlace) * off.y;
}
#elif defined(BAKED_LIGHTS)
vec2 placeInMaps() { return surface.mapPlace; }
#endif

#ifdef SMOOTH_PLACES
// As packedSmoothPlace has it. The mean of places along normals less the place of the mean is what a sum over the sides
// is: twice the height (heightOverTriangle of smooth_surface.h).
uvec2 smoothPlaceHere(vec3 face) {
  vec3 nx = dFdx(surface.vertex.xyz);
  vec3 ny = dFdy(surface.vertex.xyz);
  float side = dot(surface.vertex.xyz, face) < 0.0 ? -1.0 : 1.0;
  vec3 between = side * normalize(surface.vertex.xyz);
  // Less than what interpolation leaves of equal normals' difference is none.
  bool differ = dot(nx, nx) + dot(ny, ny) > 1e-11;
  bool bends = side * outwardBend(dFdx(surface.relative), dFdy(surface.relative), nx, ny) > 0.0;
  if (!differ || !bends || dot(between, normalize(face)) <= kLeastLikeness) return kNoSmoothPlace;
  float height = 0.5 * side * (surface.vertex.w - dot(surface.vertex.xyz, surface.relative));
  return packedSmoothPlace(between, max(height, 0.0));
}
#endif

void main() {
  MaterialData material = materials[materialIndex];
  vec4 color = baseColor(material);
#ifdef ALPHA_MASK
#ifdef BASE_COLOR_TEXTURE
  float factor = material.baseColorFactor.a;
#ifdef VERTEX_COLORS
  factor *= surface.color.a;
#endif
  vec2 right = BASE_COLOR_STEP(dFdx);
  vec2 up = BASE_COLOR_STEP(dFdy);
  if (!isFilled(material, factor, BASE_COLOR_TEXEL(baseColorTexture).a, BASE_COLOR_PLACE, right, up)) discard;
#else
  if (color.a < material.alphaCutoff) discard;
#endif
#endif
  // The pixel's centre: at an edge it may lie just off the surface, in its plane.
  vec3 toEye = frame.perspective != 0u ? -surface.relative : -frame.forward;
  vec3 face = faceNormal(toEye);
#ifdef SPECULAR_GLOSSINESS
  vec2 metallicRoughness = fromSpecularGlossiness(material, color.rgb);
#else
  vec2 metallicRoughness = metallicRoughnessOf(material);
#endif
#ifdef EMISSION
  vec4 glow = vec4(emissionOf(material), 0.0);
#endif
#ifdef UNLIT
  glow = vec4(color.rgb, 1.0);
#elif defined(TRANSMISSION)
  // The diffuse part gives way to the surroundings behind, unshadowed and unbent.
  float passing = material.transmission * (1.0 - metallicRoughness.x);
  vec3 behind = radianceOfSurroundings(-normalize(toEye), metallicRoughness.y);
  glow.rgb += passing * color.rgb * behind;
  color.rgb *= mix(1.0, metallicRoughness.x, passing);
#endif
  surfaceBits = packedSurface(Surface(face, shadingNormal(material, face), color.rgb, metallicRoughness.x, metallicRoughness.y,
                               occlusionOf(material)));
#ifdef RECEIVER_GROUPS
  surfaceBits = withReceiverGroup(surfaceBits, surface.receiverGroup);
#endif
#ifdef EMISSION
  emitted = glow;
#endif
#ifdef SMOOTH_PLACES
  smoothPlace = smoothPlaceHere(face);
#endif
#ifdef BAKED_LIGHTS
  bakedShares = vec4(0.0);
  vec2 place = placeInMaps();
  for (int i = 0; i < BAKED_LIGHTS; ++i) bakedShares[i] = textureLod(lightMaps[i], place, 0.0).r;
#endif
#ifdef TRIANGLE_NUMBERS
  triangleNumber = surface.firstTriangle + uint(gl_PrimitiveID);
#endif
}
