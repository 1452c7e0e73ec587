// What a surface with alpha leaves out: the same test for the eye and for the light, unless the light dithers.
#ifdef ALPHA_MASK
layout(std430, binding = GNOMON_MATERIAL_BUFFER) readonly buffer MaterialBuffer { MaterialData materials[]; };
layout(binding = GNOMON_BASE_COLOR_UNIT) uniform sampler2D baseColorTexture;
layout(location = GNOMON_MATERIAL) uniform int materialIndex;
in MaskVertex {
  vec2 uv;
  float alpha;
} mask;

#ifdef ALPHA_DITHER
// As many of each 4 x 4 texels as alpha says, spread evenly (Bayer, "An optimum method for two-level rendition of
// continuous-tone pictures", ICC 1973): none at alpha 0, all at 1.
float leastAlpha(MaterialData material) {
  uvec2 p = uvec2(gl_FragCoord.xy);
  uint x = p.x ^ p.y;
  uint rank = (x & 1u) << 3 | (p.y & 1u) << 2 | (x & 2u) | (p.y & 2u) >> 1;
  return (float(rank) + 0.5) / 16.0;
}
#else
float leastAlpha(MaterialData material) { return material.emissiveFactor.w; }
#endif

#ifdef TEXTURE_TRANSFORM
#include "common_texture_transform.glsl"
#define MASK_TEXEL movedTexel(baseColorTexture, mask.uv, GNOMON_BASE_COLOR_UNIT)
#else
#define MASK_TEXEL texture(baseColorTexture, mask.uv)
#endif

void discardMasked() {
  MaterialData material = materials[materialIndex];
  float alpha = material.baseColorFactor.a * mask.alpha;
#ifdef BASE_COLOR_TEXTURE
  alpha *= MASK_TEXEL.a;
#endif
  if (alpha < leastAlpha(material)) discard;
}
#else
void discardMasked() {}
#endif
