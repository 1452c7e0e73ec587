// Moments of the depths in a blurred shadow map, by the filter's kind, and the light that they let through.
// Depth is 0 nearest the light and 1 farthest, linear in distance.
const float kPositiveExponent = 40.0; // of a depth in -1..1: its square still fits a float
const float kNegativeExponent = 5.0;
// Light that leaks into a shadow under a second caster is cut: shares below this are none.
// (Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007, section 8.4.3.)
const float kBleeding = 0.2;

vec2 warped(float depth) {
  float z = 2.0 * depth - 1.0;
  return vec2(exp(kPositiveExponent * z), -exp(-kNegativeExponent * z));
}

vec4 momentsOf(float depth, int kind) {
  if (kind == GNOMON_FILTER_VSM) {
    float z = depth - 0.5; // centred: the squares keep more digits
    return vec4(z, z * z, 0.0, 0.0);
  }
  if (kind == GNOMON_FILTER_EVSM) {
    vec2 w = warped(depth);
    return vec4(w.x, w.x * w.x, w.y, w.y * w.y);
  }
  float z = 2.0 * depth - 1.0;
  return vec4(z, z * z, z * z * z, z * z * z * z);
}

// The greatest share of a distribution that may lie at or beyond `depth`: Chebyshev's inequality, one tail.
// (Donnelly, Lauritzen, "Variance Shadow Maps", I3D 2006.)
float chebyshev(vec2 moments, float depth, float leastVariance) {
  if (depth <= moments.x) return 1.0;
  float variance = max(moments.y - moments.x * moments.x, leastVariance);
  float beyond = depth - moments.x;
  return variance / (variance + beyond * beyond);
}

// The least share that lies before `depth`, from four moments: the three-point distribution with a point at `depth` that
// has these moments. (Peters, Klein, "Moment Shadow Mapping", I3D 2015; the bias for 32-bit floats and depths in -1..1
// from Peters et al., "Improved Moment Shadow Maps", JCGT 2017.)
float hamburger(vec4 moments, float depth) {
  vec4 m = mix(moments, vec4(0.0, 0.375, 0.0, 0.375), 3e-7);
  // Solve H x = (1, depth, depth^2), H the Hankel matrix of the moments, by H = L D L^T.
  float d1 = max(m.y - m.x * m.x, 1e-12);
  float l21 = (m.z - m.x * m.y) / d1;
  float d2 = max(m.w - m.y * m.y - l21 * l21 * d1, 1e-12);
  float y1 = depth - m.x;
  float y2 = depth * depth - m.y - l21 * y1;
  float x2 = y2 / d2;
  float x1 = y1 / d1 - l21 * x2;
  float x0 = 1.0 - m.x * x1 - m.y * x2;
  // The other two points: the roots of x0 + x1 z + x2 z^2.
  float half_ = -0.5 * x1 / x2;
  float spread = sqrt(max(half_ * half_ - x0 / x2, 0.0));
  float low = half_ - spread;
  float high = half_ + spread;
  if (depth <= low) return 0.0;
  if (depth <= high) {
    return clamp((depth * high - m.x * (depth + high) + m.y) / ((high - low) * (depth - low)), 0.0, 1.0);
  }
  return clamp(1.0 - (low * high - m.x * (low + high) + m.y) / ((depth - low) * (depth - high)), 0.0, 1.0);
}

float withoutBleeding(float share) { return clamp((share - kBleeding) / (1.0 - kBleeding), 0.0, 1.0); }

// Share of the light that arrives at `depth`.
float visibilityFrom(vec4 moments, float depth, int kind) {
  if (kind == GNOMON_FILTER_VSM) return withoutBleeding(chebyshev(moments.xy, depth - 0.5, 1e-7));
  if (kind == GNOMON_FILTER_EVSM) {
    // (Lauritzen, McCool, "Layered Variance Shadow Maps", GI 2008; least variance: 1e-4 of the depth, warped.)
    vec2 w = warped(depth);
    vec2 least = 1e-4 * vec2(kPositiveExponent, kNegativeExponent) * w;
    least *= least;
    return withoutBleeding(min(chebyshev(moments.xy, w.x, least.x), chebyshev(moments.zw, w.y, least.y)));
  }
  return withoutBleeding(1.0 - hamburger(moments, 2.0 * depth - 1.0));
}
