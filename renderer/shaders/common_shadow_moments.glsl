// Lookups in the blurred shadow maps.
#ifdef FILTER_MOMENTS
#include "shared/moments.h"
layout(binding = GNOMON_MOMENTS_UNIT) uniform sampler2D momentAtlas;

float momentVisibility(vec2 coordinate, float depth, int kind) {
  return visibilityFrom(textureLod(momentAtlas, coordinate, 0.0), depth, kind);
}
#endif
