// Percentage-closer soft shadows. (Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH 2005.) Depths of light from a
// point are lines in 1 / distance, as the width of a penumbra is, seen from the light: one formula serves all lights.
#ifdef FILTER_PCSS
// The radius of the penumbra, a length across the light, for each z between caster and receiver.
float penumbraPerDepth(LightData light, TileData tile) {
  return light.filterRadius / (tile.texelDepth * tile.atlasPerMetre.x * atlasTexelCount().x);
}

// Texels of a length across the light.
float texelsAcross(TileData tile, float radius) {
  vec2 texels = radius * tile.atlasPerMetre * atlasTexelCount();
  return max(texels.x, texels.y);
}

// The mean z between the receiver and what stands between it and the light's disc; where the search meets no such caster,
// of all that stand before the receiver's plane within `radius`: it may have missed one. Negative where nothing does. The
// places are the denser the nearer: they find low casters beside high ones.
float casterHeight(LightData light, TileData tile, Lookup at, vec2 slope, float radius) {
  vec2 texels = atlasTexelCount();
  float turn = discTurn();
  float perDepth = penumbraPerDepth(light, tile);
  // A texel may show what stands as far off its centre, and the comparison reads as many around.
  float seen = 2.0 / texelsAcross(tile, 1.0);
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
    plane -= 0.5 * (abs(slope.x) + abs(slope.y)); // a sample may lie half a texel off the centre
#endif
    float depth = outside ? 1.0 : texelFetch(atlas, texel, i % ATLAS_SAMPLES).r;
    if (depth >= min(plane, 1.0)) continue;
    float height = max(at.coordinate.z - depth, 0.0);
    standing += vec2(height, 1.0);
    if (perDepth * height + seen >= reach) covering += vec2(height, 1.0);
  }
  vec2 mean = covering.y > 0.0 ? covering : standing;
  return mean.y > 0.0 ? mean.x / mean.y : -1.0;
}

// The radius of the penumbra at a receiver, a length across the light; negative where nothing stands before it.
float penumbraRadius(LightData light, TileData tile, Lookup at, vec2 slope) {
  float perDepth = penumbraPerDepth(light, tile);
  float reach = min(perDepth * max(at.coordinate.z, 0.0), tile.filterReach);
  at.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0 + texelsAcross(tile, reach));
  float height = casterHeight(light, tile, at, slope, reach);
  return height < 0.0 ? height : min(perDepth * height, reach);
}

float pcssVisibility(LightData light, TileData tile, Lookup at, vec2 slope) {
  float radius = penumbraRadius(light, tile, at, slope);
  if (radius < 0.0) return 1.0;
  at.coordinate.z -= bendRoom(light, tile, at.divisor, slope, 1.0 + texelsAcross(tile, radius));
  return discVisibility(tile, at, slope, radius, radius / penumbraPerDepth(light, tile));
}
#endif
