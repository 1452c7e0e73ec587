#include "shared/frame_types.h"
#include "common_transform.glsl"

// Negative: the position is in the primitive's own space; else it is homogeneous with this for its fourth coordinate,
// relative to the eye.
layout(location = GNOMON_PLACE_WEIGHT) in float weight;

invariant gl_Position;

void main() {
  if (weight < 0.0) {
    gl_Position = frame.clipFromRelative * vec4(relativeFromLocal(position), 1.0);
  } else {
    gl_Position = frame.clipFromRelative * vec4(position, weight);
  }
}
