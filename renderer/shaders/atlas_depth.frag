#include "shared/frame_types.h"

// One depth a texel of an atlas that has several: the nearest to the light.
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2DMS atlas;
layout(location = 0) out float nearest;

void main() {
  nearest = 1.0;
  for (int i = 0; i < SAMPLES; ++i) nearest = min(nearest, texelFetch(atlas, ivec2(gl_FragCoord.xy), i).r);
}
