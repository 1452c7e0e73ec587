#include "shared/frame_types.h"

// What the samples of a pixel say, as the channels of one texel.
layout(binding = GNOMON_SURFACE_UNIT) uniform usampler2DMS triangleNumbers;
layout(location = 0) out uvec4 numbers;

void main() {
  for (int i = 0; i < SAMPLES; ++i) numbers[i] = texelFetch(triangleNumbers, ivec2(gl_FragCoord.xy), i).r;
}
