#include "shared/frame_types.h"
#include "common_transform.glsl"
#include "common_mask_vertex.glsl"

layout(location = GNOMON_LIGHT_CLIP) uniform mat4 clipFromAnchored;

#if defined(CASTER_NODE) || defined(ALPHA_DITHER)
layout(location = GNOMON_NODE) in vec4 nodeRow;
flat out int casterNode;
#endif
#ifdef ALPHA_DITHER
flat out int provokingVertex; // which triangle it is, whatever else is drawn
#endif

void main() {
  gl_Position = clipFromAnchored * vec4(relativeFromLocal(position), 1.0);
  passMask();
#if defined(CASTER_NODE) || defined(ALPHA_DITHER)
  casterNode = int(nodeRow.w);
#endif
#ifdef ALPHA_DITHER
  provokingVertex = gl_VertexID;
#endif
}
