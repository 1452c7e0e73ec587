layout(std430, binding = GNOMON_MATERIAL_BUFFER) readonly buffer MaterialBuffer { MaterialData materials[]; };
layout(location = GNOMON_MATERIAL) uniform int materialIndex;

#ifdef BASE_COLOR_TEXTURE
layout(binding = GNOMON_BASE_COLOR_UNIT) uniform sampler2D baseColorTexture;
#endif
#ifdef METALLIC_ROUGHNESS_TEXTURE
layout(binding = GNOMON_METALLIC_ROUGHNESS_UNIT) uniform sampler2D metallicRoughnessTexture;
#endif
#ifdef NORMAL_TEXTURE
layout(binding = GNOMON_NORMAL_UNIT) uniform sampler2D normalTexture;
#endif
#ifdef OCCLUSION_TEXTURE
layout(binding = GNOMON_OCCLUSION_UNIT) uniform sampler2D occlusionTexture;
#endif
#ifdef EMISSIVE_TEXTURE
layout(binding = GNOMON_EMISSIVE_UNIT) uniform sampler2D emissiveTexture;
#endif

#ifdef TEXTURE_TRANSFORM
#include "common_texture_transform.glsl"
#endif

vec4 baseColor(MaterialData material) {
  vec4 color = material.baseColorFactor;
#ifdef BASE_COLOR_TEXTURE
  color *= BASE_COLOR_TEXEL(baseColorTexture);
#endif
#ifdef VERTEX_COLORS
  color *= surface.color;
#endif
  return color;
}

// Of the triangle itself, on the eye's side; of any length.
vec3 faceNormal(vec3 toEye) {
  vec3 n = cross(dFdx(surface.relative), dFdy(surface.relative));
  return dot(n, toEye) < 0.0 ? -n : n;
}

// Of any length.
vec3 shadingNormal(MaterialData material, vec3 face) {
  vec3 n = surface.normal;
#ifdef DOUBLE_SIDED
  if (dot(n, face) < 0.0) n = -n;
#endif
#ifdef NORMAL_TEXTURE
  vec3 texel = NORMAL_TEXEL(normalTexture).xyz * 2.0 - 1.0;
  texel.xy *= material.normalScale;
#ifdef TANGENTS
  n = bentByTangent(normalize(n), surface.tangent.xyz, surface.tangent.w, texel);
#else
  n = bentBySteps(normalize(n), dFdx(surface.relative), dFdy(surface.relative), NORMAL_STEP(dFdx), NORMAL_STEP(dFdy),
                  texel);
#endif
#endif
  return n;
}

#ifdef SPECULAR_GLOSSINESS
// Turns the diffuse color into a base color; gives metal and roughness.
vec2 fromSpecularGlossiness(MaterialData material, inout vec3 color) {
  vec4 specular = vec4(material.specularFactor, material.glossinessFactor);
#ifdef METALLIC_ROUGHNESS_TEXTURE
  specular *= METALLIC_ROUGHNESS_TEXEL(metallicRoughnessTexture);
#endif
  float metallic = metallicOf(color, specular.rgb);
  color = baseColorOf(color, specular.rgb, metallic);
  return vec2(metallic, 1.0 - specular.a);
}
#endif

vec2 metallicRoughnessOf(MaterialData material) {
  vec2 value = vec2(material.metallicFactor, material.roughnessFactor);
#ifdef METALLIC_ROUGHNESS_TEXTURE
  value *= METALLIC_ROUGHNESS_TEXEL(metallicRoughnessTexture).bg;
#endif
  return value;
}

float occlusionOf(MaterialData material) {
#ifdef OCCLUSION_TEXTURE
  return mix(1.0, OCCLUSION_TEXEL(occlusionTexture).r, material.occlusionStrength);
#else
  return 1.0;
#endif
}

vec3 emissionOf(MaterialData material) {
  vec3 emission = material.emissiveFactor;
#ifdef EMISSIVE_TEXTURE
  emission *= EMISSIVE_TEXEL(emissiveTexture).rgb;
#endif
  return emission;
}
