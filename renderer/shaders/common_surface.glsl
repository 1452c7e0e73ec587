#include "common_names.glsl"
#include "shared/octahedral.h"

// What a picture's light needs to know of a surface: written once a pixel, read by every view.
struct Surface {
  vec3 face;   // normal of the triangle itself, on the eye's side; to be packed, normals may have any length
  vec3 normal; // for shading
  vec3 baseColor;
  float metallic;
  float roughness; // perceptual
  float occlusion; // of the surroundings, 1 = open
};

// The place of the curved surface that shading shows, where the triangle bends outwards: its normal, of unit length and on
// the eye's side, and its height over the triangle along that, metres.
const uvec2 kNoSmoothPlace = uvec2(0u, 0xbf800000u); // a height of -1
uvec2 packedSmoothPlace(vec3 normal, float height) {
  return uvec2(packSnorm2x16(octahedral(normal)), floatBitsToUint(height));
}

// Base colors are kept as square roots, 11, 11 and 10 bits: finer than a quarter of an sRGB byte's step.
const vec3 kColorSteps = vec3(2047.0, 2047.0, 1023.0);

uvec4 packedSurface(Surface s) {
  uvec3 color = uvec3(sqrt(clamp(s.baseColor, 0.0, 1.0)) * kColorSteps + 0.5);
  return uvec4(packSnorm2x16(octahedral(s.face)), packSnorm2x16(octahedral(s.normal)),
               color.r | (color.g << 11) | (color.b << 22), packUnorm4x8(vec4(s.metallic, s.roughness, s.occlusion, 0.0)));
}

// The receiver group (renderer/scene/node_switches.h) takes the last byte.
uvec4 withReceiverGroup(uvec4 bits, uint group) { return bits | uvec4(0u, 0u, 0u, group << 24); }
uint receiverGroup(uvec4 bits) { return bits.w >> 24; }

vec3 rootColor(uint bits) { return vec3(bits & 2047u, (bits >> 11) & 2047u, bits >> 22) / kColorSteps; }

Surface unpackedSurface(uvec4 bits) {
  vec3 color = rootColor(bits.z);
  vec3 rest = unpackUnorm4x8(bits.w).xyz;
  return Surface(fromOctahedral(unpackSnorm2x16(bits.x)), fromOctahedral(unpackSnorm2x16(bits.y)), color * color, rest.x,
                 rest.y, rest.z);
}
