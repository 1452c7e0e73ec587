// Whether a surface of a material with alpha is there, as the eye sees it: MaskCoverage::keeps, whose header
// (renderer/scene/mask_coverage.h) says why smaller levels are not simply compared with the cutoff.
#include "shared/mask_coverage.h"
layout(std430, binding = GNOMON_COVERAGE_BUFFER) readonly buffer CoverageBuffer { float coverage[]; };

// A well mixed number (Wellons, "Prospecting for Hash Functions", 2018: lowbias32).
uint mixedBits(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

// 0..1, the same for all places of a texel of the level that is nearest.
float hashOfTexel(vec2 place, float halvings) {
  vec2 at = floor(place * exp2(-floor(halvings + 0.5)));
  uvec2 texel = uvec2(ivec2(mix(vec2(0.0), at, lessThan(abs(at), vec2(1e9)))));
  return float(mixedBits(texel.x + mixedBits(texel.y)) >> 8) * (1.0 / 16777216.0);
}

// The share of places whose alpha is less than `number`, in a row of the material's table.
float shareBelow(MaterialData material, float row, int number) {
  int first = (int(material.coverageRow) + int(row)) * GNOMON_COVERAGE_ROW + number;
  float share = fract(row);
  float one = coverage[first];
  return share > 0.0 ? mix(one, coverage[first + GNOMON_COVERAGE_ROW], share) : one;
}

// `texel`: alpha as it was read at uv; right, up: how uv moves from pixel to pixel; factor: of the material and its
// vertices.
bool isFilled(MaterialData material, float factor, float texel, vec2 uv, vec2 right, vec2 up) {
  float cutoff = material.alphaCutoff;
  vec2 size = vec2(textureSize(baseColorTexture, 0));
  float squared = max(dot(right * size, right * size), dot(up * size, up * size));
  float halvings = 0.5 * log2(max(squared, 1e-20));
  float read = material.mixesLevels > 0.0 ? halvings : ceil(halvings - 0.5);
  int alpha = int(texel * 255.0 + 0.5);
  if (material.coverageLastRow == 0.0 || !(read > 0.0) || alpha == 0 || alpha == 255) return texel * factor >= cutoff;
  float least = ceil(255.0 * cutoff / factor - 1e-3);
  if (!(least <= 255.0)) return false; // nor where the factor is 0
  float row = min(2.0 * read, material.coverageLastRow);
  float low = shareBelow(material, row, alpha);
  float rank = low + hashOfTexel(uv * size, halvings) * (shareBelow(material, row, alpha + 1) - low);
  return rank >= shareBelow(material, 0.0, int(max(least, 0.0)));
}
