#include "shared/frame_types.h"

// One channel a sample: 1 where it lies in no shadow volume, else 0.
#if SAMPLES > 1
layout(binding = 0) uniform usampler2DMS stencilCounts;
#else
layout(binding = 0) uniform usampler2D stencilCounts;
#endif
layout(location = 0) out vec4 visibility;

void main() {
  visibility = vec4(1.0);
  for (int s = 0; s < SAMPLES; ++s) {
    uint count = texelFetch(stencilCounts, ivec2(gl_FragCoord.xy), s).r;
    visibility[s] = count == 0u ? 1.0 : 0.0;
  }
}
