// Percentage-closer filtering over a disc of the world, and over one as wide as the penumbra.
#if defined(FILTER_DISC) || defined(FILTER_PCSS)
// Where the picture shows the receiver.
#ifndef SHADED_PIXEL
#define SHADED_PIXEL gl_FragCoord.xy
#endif

// Turns the taps by pixel, so that their pattern shows as fine noise and not as bands.
// (Jimenez, "Next Generation Post Processing in Call of Duty", 2014: interleaved gradient noise.)
float discTurn() { return 6.2831853 * fract(52.9829189 * fract(dot(SHADED_PIXEL, vec2(0.06711056, 0.00583715)))); }

// Of a disc so far before the receiver that all of it is above its plane.
const float kWholeDisc = 1e30;

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
