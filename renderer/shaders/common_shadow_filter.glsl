// Comparisons with the depths of the shadow atlas. The receiver's plane is held against each texel at that texel's place, so
// that a surface does not shadow itself however wide the kernel. (Isidoro, "Shadow Mapping: GPU-based Tips and
// Techniques", GDC 2006.)

// The depths of the receiver's plane.
struct PlaneDepths {
  float depth; // at the place that is looked up
  vec2 slope;  // with each texel
};

// The plane as depths of the map: where nothing is drawn that is 1. All that lies before the first depth is drawn at 0.
vec4 mapDepths(vec4 plane) { return min(plane, 1.0); }

#if ATLAS_SAMPLES > 1
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2DMS atlas;

vec2 atlasTexelCount() { return vec2(textureSize(atlas)); }

// Share of a texel's samples that are no nearer to the light than the plane.
float texelVisibility(ivec2 texel, vec2 offset, PlaneDepths plane) {
  vec4 depths = vec4(texelFetch(atlas, texel, 0).r, texelFetch(atlas, texel, 1).r, texelFetch(atlas, texel, 2).r,
                     texelFetch(atlas, texel, 3).r);
  float held = plane.depth + dot(plane.slope, offset) - halfTexelRise(plane.slope);
  return dot(step(mapDepths(vec4(held)), depths), vec4(0.25));
}

// A texel that lies beside the place weighs as one under it. `place` is in texels.
float kernelVisibility(vec2 place, PlaneDepths plane, int size) {
  ivec2 middle = ivec2(place);
  int reach = size / 2;
  float sum = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      ivec2 texel = middle + ivec2(x, y);
      sum += texelVisibility(texel, vec2(texel) + 0.5 - place, plane);
    }
  }
  return sum / float(size * size);
}

float tapVisibility(vec2 place, PlaneDepths plane) { return kernelVisibility(place, plane, 1); }
#else
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2D atlas;

vec2 atlasTexelCount() { return vec2(textureSize(atlas, 0)); }

// The plane's rise from where four texels meet to each of them, in the order of textureGather: upper left, upper right,
// lower right, lower left.
vec4 risesAround(vec2 slope) {
  return 0.5 * (slope.x * vec4(-1.0, 1.0, 1.0, -1.0) + slope.y * vec4(1.0, 1.0, -1.0, -1.0));
}

// 1 for each of the four that is no nearer to the light than the plane. `corner` is where they meet, in the atlas.
vec4 litAround(vec2 corner, vec4 plane) { return step(mapDepths(plane), textureGather(atlas, corner)); }

// One comparison, bilinear.
float tapVisibility(vec2 place, PlaneDepths plane) {
  vec2 corner = floor(place - 0.5) + 1.0;
  vec2 fraction = place + 0.5 - corner;
  vec4 held = plane.depth + dot(plane.slope, corner - place) + risesAround(plane.slope);
  vec4 lit = litAround(corner / atlasTexelCount(), held);
  vec2 rows = mix(lit.wx, lit.zy, fraction.x);
  return mix(rows.x, rows.y, fraction.y);
}

// Weights of a kernel of 3, 5 or 7 bilinear comparisons a side, each the next one's neighbour: size + 1 texels, in pairs.
void kernelWeights(int size, float fraction, out vec2 pairs[4]) {
  float kernel[9] = float[9](0.0, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  if (size == 5) kernel = float[9](0.0, 1.0, 3.0, 4.0, 3.0, 1.0, 0.0, 0.0, 0.0);
  if (size == 7) kernel = float[9](0.0, 1.0, 5.0, 12.0, 16.0, 12.0, 5.0, 1.0, 0.0);
  for (int i = 0; i < 4; ++i) {
    pairs[i] = vec2(mix(kernel[2 * i + 1], kernel[2 * i], fraction), mix(kernel[2 * i + 2], kernel[2 * i + 1], fraction));
  }
}

// `place` is in texels.
float kernelVisibility(vec2 place, PlaneDepths plane, int size) {
  if (size <= 1) return tapVisibility(place, plane);
  vec2 base = floor(place - 0.5);
  vec2 fraction = place - 0.5 - base;
  vec2 weightsX[4];
  vec2 weightsY[4];
  kernelWeights(size, fraction.x, weightsX);
  kernelWeights(size, fraction.y, weightsY);
  vec2 first = base - float(size / 2) + 1.0; // the first corner
  vec4 held = plane.depth + dot(plane.slope, first - place) + risesAround(plane.slope);
  vec2 texel = 1.0 / atlasTexelCount(); // exact: sides are powers of two
  int count = (size + 1) / 2;
  float sum = 0.0;
  float weightX = 0.0;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      vec2 along = 2.0 * vec2(x, y);
      vec4 lit = litAround((first + along) * texel, held + dot(plane.slope, along));
      sum += weightsY[y].x * dot(weightsX[x], lit.wz) + weightsY[y].y * dot(weightsX[x], lit.xy);
    }
    weightX += weightsX[y].x + weightsX[y].y;
  }
  return sum / (weightX * weightX); // the same along both axes
}
#endif

#ifdef FILTER_MOMENTS
#include "shared/moments.h"
layout(binding = GNOMON_MOMENTS_UNIT) uniform sampler2D momentAtlas;

float momentVisibility(vec2 coordinate, float depth, int kind) {
  return visibilityFrom(textureLod(momentAtlas, coordinate, 0.0), depth, kind);
}
#endif
