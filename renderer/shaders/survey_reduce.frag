#include "shared/frame_types.h"

// One fragment for a block of pixels: the greatest and the least depth of its samples that show a surface, and how many
// show none.
#if SAMPLES > 1
#define DEPTHS sampler2DMS
#else
#define DEPTHS sampler2D
#endif
layout(binding = 0) uniform DEPTHS depthTexture;
#ifdef PART
// Of some surfaces alone: only where they are what is shown, something is.
layout(binding = 1) uniform DEPTHS partTexture;
#endif
layout(location = GNOMON_FRAME_SIZE) uniform ivec2 frameSize;
layout(location = 0) out vec4 depths; // nearest (greatest), farthest, 0 and 1 where there is no surface; open samples

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * GNOMON_BLOCK_SIZE;
  ivec2 last = min(first + GNOMON_BLOCK_SIZE, frameSize);
  depths = vec4(0.0, 1.0, 0.0, 0.0);
  for (int y = first.y; y < last.y; ++y) {
    for (int x = first.x; x < last.x; ++x) {
      for (int s = 0; s < SAMPLES; ++s) {
        ivec2 texel = ivec2(x, frameSize.y - 1 - y);
        float depth = texelFetch(depthTexture, texel, s).r;
#ifdef PART
        if (texelFetch(partTexture, texel, s).r != depth) depth = 0.0;
#endif
        depths.x = max(depths.x, depth);
        depths.y = min(depths.y, depth > 0.0 ? depth : 1.0);
        depths.z += depth > 0.0 ? 0.0 : 1.0;
      }
    }
  }
}
