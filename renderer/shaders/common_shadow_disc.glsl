// Percentage-closer filtering over a disc of the world, and over one as wide as the penumbra (FILTER_PCSS).
#if defined(FILTER_DISC) || defined(FILTER_PCSS)
// Where the picture shows the receiver.
#ifndef SHADED_PIXEL
#define SHADED_PIXEL gl_FragCoord.xy
#endif

#include "shared/shadow_disc.h"

float discTurn() { return noiseTurn(dot(SHADED_PIXEL, vec2(kNoiseX, kNoiseY))); }

float texelsAcross(TileData tile, float radius) {
  vec2 texels = atlasTexelCount();
  return texelsAcross(tile, radius, texels.x, texels.y);
}

// `radius`: a length across the light. The disc lies `height` (z) before the receiver; what of it is below the receiver's
// own plane does not count.
float discVisibility(TileData tile, Lookup at, vec2 slope, float radius, float height) {
  vec2 texels = atlasTexelCount();
  float turn = discTurn();
  float sum = 0.0;
  float count = 0.0;
  for (int i = 0; i < GNOMON_DISC_TAPS; ++i) {
    // Vogel's spiral: equal areas.
    float angle = turn + float(i) * GNOMON_GOLDEN_ANGLE;
    vec2 step = vec2(cos(angle), sin(angle)) * (radius * sqrt((float(i) + 0.5) / float(GNOMON_DISC_TAPS)));
    vec2 place = at.coordinate.xy + step * tile.atlasPerMetre;
    float rise = dot(slope, (place - at.coordinate.xy) * texels);
    if (rise < -height) continue;
    count += 1.0;
    bool outside = any(lessThan(place, tile.lowest)) || any(greaterThan(place, tile.highest));
    sum += outside ? 1.0 : tapVisibility(place * texels, PlaneDepths(at.coordinate.z + rise, slope));
  }
  return sum / max(count, 1.0);
}
#endif

#ifdef FILTER_PCSS
float penumbraPerDepth(LightData light, TileData tile) { return penumbraPerDepth(light, tile, atlasTexelCount().x); }

// The mean z between the receiver and what stands between it and the light's disc; where the search meets no such caster,
// of all that stand before the receiver's plane within `radius`: it may have missed one. Negative where nothing does. The
// places are the denser the nearer: they find low casters beside high ones.
float casterHeight(LightData light, TileData tile, Lookup at, vec2 slope, float radius) {
  vec2 texels = atlasTexelCount();
  float turn = discTurn();
  float perDepth = penumbraPerDepth(light, tile);
  float seen = seenAround(tile, texels.x, texels.y);
  vec2 covering = vec2(0.0); // sum and count
  vec2 standing = vec2(0.0);
  for (int i = 0; i < GNOMON_SEARCH_TAPS; ++i) {
    float angle = turn + float(i) * GNOMON_GOLDEN_ANGLE;
    float share = float(i) / float(GNOMON_SEARCH_TAPS - 1);
    float reach = radius * share * share;
    vec2 place = at.coordinate.xy + vec2(cos(angle), sin(angle)) * reach * tile.atlasPerMetre;
    bool outside = any(lessThan(place, tile.lowest)) || any(greaterThan(place, tile.highest));
    ivec2 texel = ivec2(place * texels);
    float plane = at.coordinate.z + dot(slope, vec2(texel) + 0.5 - at.coordinate.xy * texels);
#if ATLAS_SAMPLES > 1
    plane -= halfTexelRise(slope);
#endif
    float depth = outside ? 1.0 : texelFetch(atlas, texel, i % ATLAS_SAMPLES).r;
    if (depth >= min(plane, 1.0)) continue;
    float height = max(at.coordinate.z - depth, 0.0);
    standing += vec2(height, 1.0);
    if (perDepth * height + seen >= reach) covering += vec2(height, 1.0);
  }
  return meanHeight(covering.x, covering.y, standing.x, standing.y);
}

// The radius of the penumbra at a receiver, a length across the light; negative where nothing stands before it.
float penumbraRadius(LightData light, TileData tile, Lookup at, vec2 slope) {
  float perDepth = penumbraPerDepth(light, tile);
  float reach = searchReach(tile, perDepth, at.coordinate.z);
  at.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0 + texelsAcross(tile, reach));
  float height = casterHeight(light, tile, at, slope, reach);
  return radiusOfHeight(perDepth, height, reach);
}

float pcssVisibility(LightData light, TileData tile, Lookup at, vec2 slope) {
  float radius = penumbraRadius(light, tile, at, slope);
  if (radius < 0.0) return 1.0;
  at.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0 + texelsAcross(tile, radius));
  return discVisibility(tile, at, slope, radius, radius / penumbraPerDepth(light, tile));
}
#endif
