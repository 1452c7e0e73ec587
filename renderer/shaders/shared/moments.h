// Moments of the depths in a blurred shadow map, by the filter's kind (GNOMON_FILTER_...), and the light that they let
// through. Depth is 0 nearest the light and 1 farthest, linear in distance.
GNOMON_CONSTANT(kPositiveExponent, 40.0f); // of a depth in -1..1: its square still fits a float
GNOMON_CONSTANT(kNegativeExponent, 5.0f);
// Light that leaks into a shadow under a second caster is cut: shares below this are none.
// (Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007, section 8.4.3.)
GNOMON_CONSTANT(kBleeding, 0.2f);

GNOMON_FUNCTION vec2 warped(Real depth) {
  Real z = 2.0f * depth - 1.0f;
  return vec2(exp(kPositiveExponent * z), -exp(-kNegativeExponent * z));
}

GNOMON_FUNCTION vec4 momentsOf(Real depth, int kind) {
  if (kind == GNOMON_FILTER_VSM) {
    Real centred = depth - 0.5f; // the squares keep more digits
    return vec4(centred, centred * centred, 0.0f, 0.0f);
  }
  if (kind == GNOMON_FILTER_EVSM) {
    vec2 w = warped(depth);
    return vec4(w.x, w.x * w.x, w.y, w.y * w.y);
  }
  Real z = 2.0f * depth - 1.0f;
  return vec4(z, z * z, z * z * z, z * z * z * z);
}

// A receiver's depth as moments are made of it. `z`, `divisor`: as in Lookup.
GNOMON_FUNCTION Real momentDepth(TileData tile, Real z, Real divisor) {
#ifdef PUNCTUAL
  if (tile.perspective != 0u) {
    // Depths of the map, made linear, are no finer than this.
    Real bias = (3.0f * tile.depthBias * divisor * divisor + tile.depthBiasNear) / (tile.near * tile.far);
    return clamp((divisor - tile.near) / (tile.far - tile.near) - bias, 0.0f, 1.0f);
  }
#endif
  return clamp(z, 0.0f, 1.0f);
}

// Of a depth in the map of a perspective tile between `nearest` and `farthest`, metres; 0 0 for parallel light.
GNOMON_FUNCTION Real linearDepth(float nearest, float farthest, Real z) {
  if (farthest <= 0.0f) return z;
  float span = farthest - nearest;
  Real distance = nearest * farthest / (farthest - z * span);
  return clamp((distance - nearest) / span, 0.0f, 1.0f);
}

// The greatest share of a distribution that may lie at or beyond `depth`: Chebyshev's inequality, one tail.
// (Donnelly, Lauritzen, "Variance Shadow Maps", I3D 2006.)
GNOMON_FUNCTION Real chebyshev(Real mean, Real square, Real depth, Real leastVariance) {
  Real variance = max(square - mean * mean, leastVariance);
  Real beyond = depth - mean;
  return select(depth <= mean, Real(1.0f), variance / (variance + beyond * beyond));
}

// The least share that lies before `depth`, from four moments: the three-point distribution with a point at `depth`
// that has these moments. (Peters, Klein, "Moment Shadow Mapping", I3D 2015; the bias for 32-bit floats and depths in
// -1..1 from Peters et al., "Improved Moment Shadow Maps", JCGT 2017.)
GNOMON_FUNCTION Real hamburger(vec4 moments, Real depth) {
  Real mx = mix(moments.x, 0.0f, 3e-7f);
  Real my = mix(moments.y, 0.375f, 3e-7f);
  Real mz = mix(moments.z, 0.0f, 3e-7f);
  Real mw = mix(moments.w, 0.375f, 3e-7f);
  // Solve H x = (1, depth, depth^2), H the Hankel matrix of the moments, by H = L D L^T.
  Real d1 = max(my - mx * mx, 1e-12f);
  Real l21 = (mz - mx * my) / d1;
  Real d2 = max(mw - my * my - l21 * l21 * d1, 1e-12f);
  Real y1 = depth - mx;
  Real y2 = depth * depth - my - l21 * y1;
  Real x2 = y2 / d2;
  Real x1 = y1 / d1 - l21 * x2;
  Real x0 = 1.0f - mx * x1 - my * x2;
  // The other two points: the roots of x0 + x1 z + x2 z^2.
  Real middle = -0.5f * x1 / x2;
  Real spread = sqrt(max(middle * middle - x0 / x2, 0.0f));
  Real low = middle - spread;
  Real high = middle + spread;
  Real between = (depth * high - mx * (depth + high) + my) / ((high - low) * (depth - low));
  Real beyond = 1.0f - (low * high - mx * (low + high) + my) / ((depth - low) * (depth - high));
  Real share = clamp(select(depth <= high, between, beyond), 0.0f, 1.0f);
  return select(depth <= low, Real(0.0f), share);
}

GNOMON_FUNCTION Real withoutBleeding(Real share) {
  return clamp((share - kBleeding) / (1.0f - kBleeding), 0.0f, 1.0f);
}

// Share of the light that arrives at `depth`.
GNOMON_FUNCTION Real visibilityFrom(vec4 moments, Real depth, int kind) {
  if (kind == GNOMON_FILTER_VSM) return withoutBleeding(chebyshev(moments.x, moments.y, depth - 0.5f, 1e-7f));
  if (kind == GNOMON_FILTER_EVSM) {
    // (Lauritzen, McCool, "Layered Variance Shadow Maps", GI 2008; least variance: 1e-4 of the depth, warped.)
    vec2 w = warped(depth);
    vec2 least = 1e-4f * (vec2(kPositiveExponent, kNegativeExponent) * w);
    return withoutBleeding(min(chebyshev(moments.x, moments.y, w.x, least.x * least.x),
                               chebyshev(moments.z, moments.w, w.y, least.y * least.y)));
  }
  return withoutBleeding(1.0f - hamburger(moments, 2.0f * depth - 1.0f));
}
