// Percentage-closer filtering over a disc of the world, each tap held against the receiver's own plane: the plane takes
// the bias' place, so that a wide disc lifts no shadow off its caster.
// (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC 2006.)
#ifdef FILTER_DISC
const int kDiscTaps = 32;

// Where the picture shows the receiver.
#ifndef SHADED_PIXEL
#define SHADED_PIXEL gl_FragCoord.xy
#endif

// Turns the taps by pixel, so that their pattern shows as fine noise and not as bands.
// (Jimenez, "Next Generation Post Processing in Call of Duty", 2014: interleaved gradient noise.)
float discTurn() { return 6.2831853 * fract(52.9829189 * fract(dot(SHADED_PIXEL, vec2(0.06711056, 0.00583715)))); }

float discVisibility(TileData tile, Receiver receiver, Lookup at, float radius, vec3 lightPosition) {
  vec2 slope = receiverSlope(tile, receiver, lightPosition);
#ifdef PUNCTUAL
  if (!isParallel(tile)) radius = min(radius / at.divisor, 0.5); // kWidestTangent of renderer/shadow/fit.h
#endif
  float turn = discTurn();
  float sum = 0.0;
  for (int i = 0; i < kDiscTaps; ++i) {
    // Vogel's spiral: equal areas.
    float angle = turn + float(i) * 2.39996323;
    vec2 step = vec2(cos(angle), sin(angle)) * (radius * sqrt((float(i) + 0.5) / float(kDiscTaps)));
    vec2 place = at.coordinate.xy + step * tile.bias.zw;
    bool outside = any(lessThan(place, tile.bounds.xy)) || any(greaterThan(place, tile.bounds.zw));
    float depth = clamp(at.coordinate.z + dot(slope, step), 0.0, 1.0);
    sum += outside ? 1.0 : tapVisibility(vec3(place, depth));
  }
  return sum / float(kDiscTaps);
}
#endif
