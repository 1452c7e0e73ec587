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

vec4 baseColor(MaterialData material) {
  vec4 color = material.baseColorFactor;
#ifdef BASE_COLOR_TEXTURE
  color *= texture(baseColorTexture, BASE_COLOR_UV);
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
  vec2 ux = dFdx(NORMAL_UV);
  vec2 uy = dFdy(NORMAL_UV);
  vec3 pxPerp = cross(n, px);
  vec3 pyPerp = cross(py, n);
  vec3 t = pyPerp * ux.x + pxPerp * uy.x;
  vec3 b = pyPerp * ux.y + pxPerp * uy.y;
  float longest = max(dot(t, t), dot(b, b));
  if (!(longest > 0.0)) return mat3(vec3(0.0), vec3(0.0), n);
  float scale = inversesqrt(longest);
  return mat3(t * scale, -b * scale, n);
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
  vec3 texel = texture(normalTexture, NORMAL_UV).xyz * 2.0 - 1.0;
  texel.xy *= material.surface.z;
  n = tangentFrame(normalize(n)) * texel;
#endif
  return n;
}

vec2 metallicRoughnessOf(MaterialData material) {
  vec2 value = material.surface.xy;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  value *= texture(metallicRoughnessTexture, METALLIC_ROUGHNESS_UV).bg;
#endif
  return value;
}

float occlusionOf(MaterialData material) {
#ifdef OCCLUSION_TEXTURE
  return mix(1.0, texture(occlusionTexture, OCCLUSION_UV).r, material.surface.w);
#else
  return 1.0;
#endif
}

vec3 emissionOf(MaterialData material) {
  vec3 emission = material.emissiveFactor.rgb;
#ifdef EMISSIVE_TEXTURE
  emission *= texture(emissiveTexture, EMISSIVE_UV).rgb;
#endif
  return emission;
}
