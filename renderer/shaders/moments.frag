#include "shared/frame_types.h"
#include "common_names.glsl"
#include "shared/moments.h"

// One direction of a separable box blur over one tile: from the atlas' depths along x, or from the blurred rows along y.
#ifdef ALONG_X
#if ATLAS_SAMPLES > 1
layout(binding = 0) uniform sampler2DMS depths;
#else
layout(binding = 0) uniform sampler2D depths;
#endif
#else
layout(binding = 0) uniform sampler2D rows;
#endif
layout(location = GNOMON_MOMENT_TILE) uniform ivec4 tile; // x, y, width, height in the atlas
layout(location = GNOMON_MOMENT_BLUR) uniform vec4 blur;  // x: texels to each side; y, z: distances of a perspective tile's
                                                          // ends, metres, 0 0 for parallel light
layout(location = 0) out vec4 target;

#ifndef FILTER_KIND
#define FILTER_KIND GNOMON_FILTER_VSM
#endif

#ifdef ALONG_X
vec4 momentsAt(ivec2 texel, int i) {
  return momentsOf(linearDepth(blur.y, blur.z, texelFetch(depths, texel, i).r), FILTER_KIND);
}

vec4 source(ivec2 at) {
  ivec2 texel = tile.xy + at;
#if ATLAS_SAMPLES > 1
  vec4 sum = vec4(0.0);
  for (int i = 0; i < ATLAS_SAMPLES; ++i) sum += momentsAt(texel, i);
  return sum / float(ATLAS_SAMPLES);
#else
  return momentsAt(texel, 0);
#endif
}
const ivec2 way = ivec2(1, 0);
#else
vec4 source(ivec2 at) { return texelFetch(rows, at, 0); }
const ivec2 way = ivec2(0, 1);
#endif

void main() {
#ifdef ALONG_X
  ivec2 here = ivec2(gl_FragCoord.xy);
#else
  ivec2 here = ivec2(gl_FragCoord.xy) - tile.xy;
#endif
  int stride = max(1, int(ceil((2.0 * blur.x + 1.0) / float(GNOMON_BLUR_TAPS))));
  int reach = int(ceil(blur.x)) / stride + 1;
  vec4 sum = vec4(0.0);
  float weight = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    float w = clamp(blur.x + 1.0 - float(abs(i * stride)), 0.0, 1.0);
    if (w <= 0.0) continue;
    sum += w * source(clamp(here + way * (i * stride), ivec2(0), tile.zw - 1));
    weight += w;
  }
  target = sum / weight;
}
