#include "shared/frame_types.h"
#include "common_alpha_mask.glsl"

flat in uint firstSlot;
layout(location = 0) out uint clusterSlot; // 0 = nothing was drawn

void main() {
  discardMasked();
  clusterSlot = firstSlot + uint(gl_PrimitiveID / GNOMON_CLUSTER_TRIANGLES) + 1u;
}
