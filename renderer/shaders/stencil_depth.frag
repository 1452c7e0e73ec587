#include "shared/frame_types.h"

// Copies a depth buffer, of several samples one. Not all in one draw by sampleIndex, for which not every driver shades
// each sample.
#if SAMPLES > 1
layout(binding = 0) uniform sampler2DMS depthTexture;
layout(location = GNOMON_SAMPLE) uniform int sampleIndex;
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
