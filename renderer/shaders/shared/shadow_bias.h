// How far from its own surface a receiver is looked up in a tile, and which depths of that surface count as its own.

// A face turned away from the light, or along it to within rounding, shadows itself: cosine to the light.
GNOMON_CONSTANT(kTurnedAway, 1e-4f);

// The cosine to the light above which a receiver's triangle leaves all of it before its plane.
GNOMON_FUNCTION Real wholeLightCosine(LightData light, vec3 relative) {
  Real whole = kTurnedAway;
  if (light.filterKind == GNOMON_FILTER_PCSS) {
    Real radius = light.filterRadius;
    if (light.type != GNOMON_DIRECTIONAL) radius /= length(vec3(light.position) - relative);
    whole = max(whole, radius);
  }
  return whole;
}

// The receiver, moved so that its surface doesn't shadow itself: automatically along its normal by
// reach * sin(angle) (see renderer/shadow/filter_kernel.h), or as the light's own bias says.
GNOMON_FUNCTION vec3 movedReceiver(LightData light, TileData tile, vec3 relative, vec3 normal, vec3 toLight) {
#ifdef MANUAL_BIAS
  if (light.hasManualBias != 0u) {
    Real manual = clamp(dot(normal, toLight), 1e-2f, 1.0f);
    Real tangent = sqrt(1.0f - manual * manual) / manual;
    return relative + normal * light.manualNormalOffset +
           toLight * (light.manualDepthBias + light.manualSlopeBias * tangent);
  }
#endif
  Real cosine = dot(normal, vec3(tile.axis));
  Real offset = tile.normalOffset * sqrt(max(1.0f - cosine * cosine, 0.0f));
#ifdef PUNCTUAL
  if (tile.perspective != 0u) offset *= along(tile.atlasFromRelative[3], relative);
#endif
  return relative + normal * offset;
}

// How the tile's depth changes on the receiver's plane with each texel.
GNOMON_FUNCTION vec2 receiverSlope(LightData light, TileData tile, vec3 relative, vec3 normal) {
  vec2 across = vec2(dot(normal, vec3(tile.right)), dot(normal, vec3(tile.up)));
#ifdef PUNCTUAL
  // z is a line in 1 / distance, and so is 1 / distance in the tangents of a plane.
  if (tile.perspective != 0u) return across / min(dot(normal, relative - vec3(light.position)), -1e-6f);
#endif
  return across / -min(dot(normal, vec3(tile.axis)), -1e-4f);
}

// The slope that comparisons follow: none where the light's own bias says all.
GNOMON_FUNCTION vec2 comparedSlope(LightData light, TileData tile, vec3 relative, vec3 normal) {
#ifdef MANUAL_BIAS
  if (light.hasManualBias != 0u) return vec2(Real(0.0f));
#endif
  return receiverSlope(light, tile, relative, normal);
}

// How far the plane rises from a texel's centre to its corner: a sample may lie half a texel off the centre.
GNOMON_FUNCTION Real halfTexelRise(vec2 slope) {
  return 0.5f * (abs(slope.x) + abs(slope.y));
}

// By how much a surface may rise over the receiver's plane within a texel and not shadow it, z: where it bends by up to
// kBendAngle radians, but no more than the plane itself rises on kBendTexels; and what a normal of 16 bits an axis may
// lean on the way to the farthest texel, `reach` away, which is more where the light all but grazes the surface.
// `divisor`: as in Lookup.
GNOMON_CONSTANT(kBendAngle, 0.1f);
GNOMON_CONSTANT(kBendTexels, 0.3f);
GNOMON_CONSTANT(kNormalRounding, 2e-4f);

GNOMON_FUNCTION Real bendRoom(LightData light, TileData tile, Real divisor, vec2 slope, Real reach) {
#ifdef MANUAL_BIAS
  if (light.hasManualBias != 0u) return 0.0f;
#endif
  // With the depth that a texel's width is worth: tan(a + bend) - tan(a) is about bend (1 + tan(a)^2).
  Real texel = tile.texelDepth / divisor;
  Real bent = texel + dot(slope, slope) / max(texel, 1e-30f);
  Real most = kBendTexels * (texel + abs(slope.x) + abs(slope.y));
  return max(min(kBendAngle * bent, most), kNormalRounding * reach * bent);
}

// `radius`: metres; as a length across the light.
GNOMON_FUNCTION Real discRadius(TileData tile, float radius, Real divisor) {
#ifdef PUNCTUAL
  if (tile.perspective != 0u) return min(radius / divisor, 0.5f); // kWidestTangent of renderer/shadow/fit.h
#endif
  return radius;
}

// The share of the light's disc that stands above the receiver's own plane: (asin x + x sqrt(1 - x^2)) / pi + 1/2 to
// within 0.0006, x from the light's middle to the plane in radii of the disc.
GNOMON_FUNCTION Real shareAbovePlane(LightData light, vec3 relative, vec3 normal, vec3 toLight) {
  Real cosine = dot(normal, toLight);
  Real x = cosine / (sqrt(max(1.0f - cosine * cosine, 1e-12f)) * light.filterRadius);
#ifdef PUNCTUAL
  if (light.type != GNOMON_DIRECTIONAL) x *= length(vec3(light.position) - relative);
#endif
  x = clamp(x, -1.0f, 1.0f);
  Real square = x * x;
  return 0.5f + x * (0.6387f + square * (-0.1288f + square * (0.0457f - 0.0556f * square)));
}
