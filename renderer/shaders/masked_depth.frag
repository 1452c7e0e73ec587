#include "shared/frame_types.h"
#include "common_alpha_mask.glsl"

void main() {
  discardMasked();
}
