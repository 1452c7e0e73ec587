#include "shared/frame_types.h"

// Copies a depth buffer, sample by sample.
#if SAMPLES > 1
layout(binding = 0) uniform sampler2DMS depthTexture;
#else
layout(binding = 0) uniform sampler2D depthTexture;
#endif

void main() {
#if SAMPLES > 1
  gl_FragDepth = texelFetch(depthTexture, ivec2(gl_FragCoord.xy), gl_SampleID).r;
#else
  gl_FragDepth = texelFetch(depthTexture, ivec2(gl_FragCoord.xy), 0).r;
#endif
}
