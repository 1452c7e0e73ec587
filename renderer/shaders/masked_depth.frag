#include "shared/frame_types.h"
#include "common_alpha_mask.glsl"

#ifdef CASTER_NODE
flat in int casterNode;
layout(location = 0) out int node;
#endif

void main() {
  discardMasked();
#ifdef CASTER_NODE
  node = casterNode;
#endif
}
