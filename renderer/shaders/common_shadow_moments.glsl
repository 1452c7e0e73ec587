// Lookups in the blurred shadow maps.
#ifdef FILTER_MOMENTS
#include "common_moments.glsl"
layout(binding = GNOMON_MOMENTS_UNIT) uniform sampler2D momentAtlas;

// The receiver's depth as moments are made of it.
float momentDepth(TileData tile, Lookup at) {
#ifdef PUNCTUAL
  if (dot(tile.atlasFromRelative[3].xyz, tile.axis) != 0.0) {
    // Depths of the map, made linear, are no finer than this.
    float bias = (3.0 * tile.depthBias * at.divisor * at.divisor + tile.depthBiasNear) / (tile.near * tile.far);
    return clamp((at.divisor - tile.near) / (tile.far - tile.near) - bias, 0.0, 1.0);
  }
#endif
  return clamp(at.coordinate.z, 0.0, 1.0);
}

float momentVisibility(vec2 coordinate, float depth, int kind) {
  return visibilityFrom(textureLod(momentAtlas, coordinate, 0.0), depth, kind);
}
#endif
