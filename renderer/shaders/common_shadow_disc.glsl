// Percentage-closer filtering over a disc of the world.
#ifdef FILTER_DISC
const int kDiscTaps = 32;

// Where the picture shows the receiver.
#ifndef SHADED_PIXEL
#define SHADED_PIXEL gl_FragCoord.xy
#endif

// Turns the taps by pixel, so that their pattern shows as fine noise and not as bands.
// (Jimenez, "Next Generation Post Processing in Call of Duty", 2014: interleaved gradient noise.)
float discTurn() { return 6.2831853 * fract(52.9829189 * fract(dot(SHADED_PIXEL, vec2(0.06711056, 0.00583715)))); }

float discVisibility(TileData tile, Lookup at, vec2 slope, float radius) {
  vec2 texels = atlasTexelCount();
#ifdef PUNCTUAL
  if (!isParallel(tile)) radius = min(radius / at.divisor, 0.5); // kWidestTangent of renderer/shadow/fit.h
#endif
  float turn = discTurn();
  float sum = 0.0;
  for (int i = 0; i < kDiscTaps; ++i) {
    // Vogel's spiral: equal areas.
    float angle = turn + float(i) * 2.39996323;
    vec2 step = vec2(cos(angle), sin(angle)) * (radius * sqrt((float(i) + 0.5) / float(kDiscTaps)));
    vec2 place = at.coordinate.xy + step * tile.atlasPerMetre;
    bool outside = any(lessThan(place, tile.lowest)) || any(greaterThan(place, tile.highest));
    float depth = at.coordinate.z + dot(slope, (place - at.coordinate.xy) * texels);
    sum += outside ? 1.0 : tapVisibility(place * texels, PlaneDepths(depth, slope));
  }
  return sum / float(kDiscTaps);
}
#endif
