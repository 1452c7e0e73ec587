// Percentage-closer filtering over a disc of the world, each tap held against the receiver's own plane: the plane takes
// the bias' place, so that a wide disc lifts no shadow off its caster.
// (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC 2006.)
#ifdef FILTER_DISC
const int kDiscTaps = 32;

// Turns the taps by pixel, so that their pattern shows as fine noise and not as bands.
// (Jimenez, "Next Generation Post Processing in Call of Duty", 2014: interleaved gradient noise.)
float discTurn() { return 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }

float discVisibility(TileData tile, Receiver receiver, Lookup at, float radius, vec3 lightPosition) {
  // The tile's axes, and how its depth changes along them on the receiver's plane.
  vec3 axis = tile.axis.xyz;
  vec3 right = tile.atlasFromRelative[0].xyz;
  vec3 up = tile.atlasFromRelative[1].xyz;
  right = normalize(right - axis * dot(right, axis));
  up = normalize(up - axis * dot(up, axis));
  vec2 across = vec2(dot(receiver.normal, right), dot(receiver.normal, up));
  vec2 slope;
#ifdef PUNCTUAL
  bool parallel = dot(tile.atlasFromRelative[3].xyz, axis) == 0.0;
#else
  const bool parallel = true;
#endif
  if (parallel) {
    slope = across / -min(dot(receiver.normal, axis), -1e-4) * dot(tile.atlasFromRelative[2].xyz, axis);
  } else {
    // z is a line in 1 / distance, and so is 1 / distance in the tangents of a plane.
    float plane = min(dot(receiver.normal, receiver.relative - lightPosition), -1e-6);
    slope = across * (-tile.interval.x * tile.interval.z / ((tile.interval.z - tile.interval.x) * plane));
    radius = min(radius / at.divisor, 0.5); // kWidestTangent of renderer/shadow/fit.h
  }
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
