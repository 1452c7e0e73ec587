#define FRAGMENT_STAGE
#include "shared/frame_types.h"
#include "common_surface_varyings.glsl"
#include "common_surface.glsl"
#include "common_names.glsl"
#include "shared/surroundings.h"
#include "shared/normal_map.h"
#include "shared/specular_glossiness.h"
#include "common_material.glsl"

layout(std140, binding = GNOMON_FRAME_BUFFER) uniform FrameBuffer { FrameData frame; };
layout(location = 0) out uvec4 surfaceBits;
#ifdef EMISSION
layout(location = 1) out vec4 emitted;
#endif
#ifdef TRIANGLE_NUMBERS
layout(location = TRIANGLE_NUMBERS) out uint triangleNumber;
#endif

void main() {
  MaterialData material = materials[materialIndex];
  vec4 color = baseColor(material);
#ifdef ALPHA_MASK
  if (color.a < material.emissiveFactor.w) discard;
#endif
  // The pixel's centre: at an edge it may lie just off the surface, in its plane.
  vec3 toEye = frame.forward.w > 0.0 ? -surface.relative : -frame.forward.xyz;
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
  float passing = material.passing.x * (1.0 - metallicRoughness.x);
  vec3 behind = frame.ambient.rgb * radianceAround(-normalize(toEye).y, metallicRoughness.y);
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
#ifdef TRIANGLE_NUMBERS
  triangleNumber = surface.firstTriangle + uint(gl_PrimitiveID);
#endif
}
