#include "shared/frame_types.h"
#include "common_transform.glsl"
#include "common_mask_vertex.glsl"

invariant gl_Position;

void main() {
  gl_Position = frame.clipFromRelative * vec4(relativeFromLocal(position), 1.0);
#ifdef BEYOND_FAR
  gl_ClipDistance[0] = -gl_Position.z; // just what the far plane cuts away
#endif
  passMask();
}
