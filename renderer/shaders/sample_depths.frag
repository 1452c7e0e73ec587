#include "shared/frame_types.h"

// The depths of a pixel's samples, as the channels of one texel.
layout(binding = GNOMON_DEPTH_UNIT) uniform sampler2DMS surfaceDepths;
layout(location = 0) out vec4 depths;

void main() {
  depths = vec4(0.0);
  for (int i = 0; i < SAMPLES; ++i) depths[i] = texelFetch(surfaceDepths, ivec2(gl_FragCoord.xy), i).r;
}
