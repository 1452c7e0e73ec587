#include "shared/frame_types.h"

// One fragment for a block of pixels: the least and greatest depth of its samples, and a mark for every cluster seen.
#if SAMPLES > 1
layout(binding = 0) uniform sampler2DMS depthTexture;
layout(binding = 1) uniform usampler2DMS clusterTexture;
#else
layout(binding = 0) uniform sampler2D depthTexture;
layout(binding = 1) uniform usampler2D clusterTexture;
#endif
layout(std430, binding = GNOMON_VISIBLE_BUFFER) buffer VisibleBuffer { uint visible[]; };
layout(location = 0) uniform ivec2 frameSize;
layout(location = 0) out vec2 depths; // greatest (nearest), least; -1 -1 = nothing

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * GNOMON_BLOCK_SIZE;
  ivec2 last = min(first + GNOMON_BLOCK_SIZE, frameSize);
  float nearest = 0.0;
  float farthest = 1.0;
  bool any = false;
  uint previous = 0u;
  for (int y = first.y; y < last.y; ++y) {
    for (int x = first.x; x < last.x; ++x) {
      ivec2 texel = ivec2(x, frameSize.y - 1 - y);
      for (int s = 0; s < SAMPLES; ++s) {
        uint slot = texelFetch(clusterTexture, texel, s).r;
        if (slot == 0u) continue;
        float depth = texelFetch(depthTexture, texel, s).r;
        nearest = max(nearest, depth);
        farthest = min(farthest, depth);
        any = true;
        if (slot != previous) {
          visible[slot - 1u] = 1u;
          previous = slot;
        }
      }
    }
  }
  depths = any ? vec2(nearest, farthest) : vec2(-1.0);
}
