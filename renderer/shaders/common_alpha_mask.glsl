// What a surface with alpha leaves out: where alpha is too low for the eye and for the light, unless the light dithers.
// The light reads the texture itself, as rays do. Smaller levels are means: where their texels are as large as the map's,
// finer holes close or open together, and what lies aslant to the light is smeared over many texels. The eye reads them,
// and common_mask_coverage.glsl keeps as much of the surface as the texture has.
#ifdef ALPHA_MASK
layout(std430, binding = GNOMON_MATERIAL_BUFFER) readonly buffer MaterialBuffer { MaterialData materials[]; };
layout(binding = GNOMON_BASE_COLOR_UNIT) uniform sampler2D baseColorTexture;
layout(location = GNOMON_MATERIAL) uniform int materialIndex;
in MaskVertex {
  vec2 uv;
#ifdef VERTEX_COLORS // else 1, which a GPU's interpolation would leave a little short of
  float alpha;
#endif
} mask;

#ifdef ALPHA_DITHER
// A well mixed number. (Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 2020: pcg.)
uint hashOf(uint seed) {
  uint state = seed * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

// Of 4 x 4 texels as many as alpha says, spread evenly (Bayer, "An optimum method for two-level rendition of
// continuous-tone pictures", ICC 1973): none at alpha 0, all at 1. What lies behind each other lets through the product
// of its shares, so the patterns of surfaces must not agree: those of a pane's two sides are the two coordinates of one
// (0, 4, 2)-net (Sobol', "On the distribution of points in a cube and the approximate evaluation of integrals", 1967);
// and each triangle exchanges the ranks in each 8 x 8 texels as a hash says, which leaves them as even. In smaller parts
// more surfaces would mix sooner, but a filter shows where parts meet.
float leastAlpha(MaterialData material) {
  uvec2 p = uvec2(gl_FragCoord.xy);
  uint x = p.x ^ p.y;
  uint rank = (x & 1u) << 3 | (p.y & 1u) << 2 | (x & 2u) | (p.y & 2u) >> 1;
  if (!gl_FrontFacing) rank ^= (rank & 1u) * 12u ^ (rank & 2u) << 2;
  uint surface = hashOf(uint(provokingVertex) + hashOf(uint(casterNode)));
  rank ^= hashOf((p.x >> 3) + hashOf((p.y >> 3) + surface)) >> 28;
  return (float(rank) + 0.5) / 16.0;
}
#else
float leastAlpha(MaterialData material) { return material.alphaCutoff; }
#endif

#ifdef TEXTURE_TRANSFORM
#include "common_texture_transform.glsl"
#define MASK_PLACE movedPlace(mask.uv, GNOMON_BASE_COLOR_UNIT)
#else
#define MASK_PLACE mask.uv
#endif
#ifdef SEEN_BY_LIGHT
#define MASK_TEXEL textureLod(baseColorTexture, MASK_PLACE, 0.0)
#elif defined(TEXTURE_TRANSFORM)
#define MASK_TEXEL movedTexel(baseColorTexture, mask.uv, GNOMON_BASE_COLOR_UNIT)
#else
#define MASK_TEXEL texture(baseColorTexture, mask.uv)
#endif

#if defined(BASE_COLOR_TEXTURE) && !defined(SEEN_BY_LIGHT)
#include "common_mask_coverage.glsl"
#ifdef TEXTURE_TRANSFORM
#define MASK_STEP(step) movedStep(step, GNOMON_BASE_COLOR_UNIT)
#else
#define MASK_STEP(step) (step)
#endif
#endif

void discardMasked() {
  MaterialData material = materials[materialIndex];
  float alpha = material.baseColorFactor.a;
#ifdef VERTEX_COLORS
  alpha *= mask.alpha;
#endif
#if defined(BASE_COLOR_TEXTURE) && !defined(SEEN_BY_LIGHT)
  vec2 right = MASK_STEP(dFdx(mask.uv));
  vec2 up = MASK_STEP(dFdy(mask.uv));
  if (!isFilled(material, alpha, MASK_TEXEL.a, MASK_PLACE, right, up)) discard;
#else
#ifdef BASE_COLOR_TEXTURE
  alpha *= MASK_TEXEL.a;
#endif
#ifdef ALPHA_DITHER
  alpha *= 1.0 - material.transmission;
#endif
  if (alpha < leastAlpha(material)) discard;
#endif
}
#else
void discardMasked() {}
#endif
