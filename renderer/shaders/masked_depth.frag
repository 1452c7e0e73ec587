#include "shared/frame_types.h"
#if defined(CASTER_NODE) || defined(ALPHA_DITHER)
flat in int casterNode;
#endif
#ifdef ALPHA_DITHER
flat in int provokingVertex;
#endif
#include "common_alpha_mask.glsl"

#ifdef CASTER_NODE
layout(location = 0) out int node;
#endif

void main() {
  discardMasked();
#ifdef CASTER_NODE
  node = casterNode;
#endif
}
