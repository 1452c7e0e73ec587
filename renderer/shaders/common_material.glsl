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

#ifdef NORMAL_TEXTURE
// Without tangents the texture's axes are found from the derivatives of position and uv
// (Schueler, "Normal Mapping Without Precomputed Tangents", ShaderX5).
mat3 tangentFrame(vec3 n) {
#ifdef TANGENTS
  vec3 t = normalize(surface.tangent.xyz - n * dot(n, surface.tangent.xyz));
  return mat3(t, cross(n, t) * surface.tangent.w, n);
#else
  vec3 px = dFdx(surface.relative);
  vec3 py = dFdy(surface.relative);
  vec2 ux = NORMAL_STEP(dFdx);
  vec2 uy = NORMAL_STEP(dFdy);
  vec3 pxPerp = cross(n, px);
  vec3 pyPerp = cross(py, n);
  vec3 t = pyPerp * ux.x + pxPerp * uy.x;
  vec3 b = pyPerp * ux.y + pxPerp * uy.y;
  float size = dot(t, t);
  if (!(size > 0.0)) return mat3(vec3(0.0), vec3(0.0), n);
  // Both axes as long as the normal however the texture is stretched, as with MikkTSpace (Mikkelsen 2008).
  t *= inversesqrt(size);
  vec3 side = cross(n, t);
  return mat3(t, dot(side, b) > 0.0 ? -side : side, n);
#endif
}
#endif

// Of any length.
vec3 shadingNormal(MaterialData material, vec3 face) {
  vec3 n = surface.normal;
#ifdef DOUBLE_SIDED
  if (dot(n, face) < 0.0) n = -n;
#endif
#ifdef NORMAL_TEXTURE
  vec3 texel = NORMAL_TEXEL(normalTexture).xyz * 2.0 - 1.0;
  texel.xy *= material.surface.z;
  n = tangentFrame(normalize(n)) * texel;
#endif
  return n;
}

#ifdef SPECULAR_GLOSSINESS
float perceivedBrightness(vec3 color) { return sqrt(dot(color * color, vec3(0.299, 0.587, 0.114))); }

// The share of metal with which metallic-roughness shows the same diffuse and specular color, as far as it can: the
// larger root of the quadratic in it that both colors' brightness give (Khronos, "Convert between workflows", appendix
// of KHR_materials_pbrSpecularGlossiness).
float metallicOf(vec3 diffuse, vec3 specular) {
  const float dielectric = 0.04;
  float s = perceivedBrightness(specular);
  if (s < dielectric) return 0.0;
  float b = perceivedBrightness(diffuse) * (1.0 - max(max(specular.r, specular.g), specular.b)) / (1.0 - dielectric) +
            s - 2.0 * dielectric;
  return clamp((-b + sqrt(max(b * b - 4.0 * dielectric * (dielectric - s), 0.0))) / (2.0 * dielectric), 0.0, 1.0);
}

// Turns the diffuse color into a base color; gives metal and roughness.
vec2 fromSpecularGlossiness(MaterialData material, inout vec3 color) {
  vec4 specular = material.specularGlossiness;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  specular *= METALLIC_ROUGHNESS_TEXEL(metallicRoughnessTexture);
#endif
  float metallic = metallicOf(color, specular.rgb);
  float left = 1.0 - max(max(specular.r, specular.g), specular.b);
  vec3 ofDiffuse = color * (left / (1.0 - 0.04) / max(1.0 - metallic, 1e-4));
  vec3 ofSpecular = (specular.rgb - 0.04 * (1.0 - metallic)) / max(metallic, 1e-4);
  color = clamp(mix(ofDiffuse, ofSpecular, metallic * metallic), 0.0, 1.0);
  return vec2(metallic, 1.0 - specular.a);
}
#endif

vec2 metallicRoughnessOf(MaterialData material) {
  vec2 value = material.surface.xy;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  value *= METALLIC_ROUGHNESS_TEXEL(metallicRoughnessTexture).bg;
#endif
  return value;
}

float occlusionOf(MaterialData material) {
#ifdef OCCLUSION_TEXTURE
  return mix(1.0, OCCLUSION_TEXEL(occlusionTexture).r, material.surface.w);
#else
  return 1.0;
#endif
}

vec3 emissionOf(MaterialData material) {
  vec3 emission = material.emissiveFactor.rgb;
#ifdef EMISSIVE_TEXTURE
  emission *= EMISSIVE_TEXEL(emissiveTexture).rgb;
#endif
  return emission;
}
