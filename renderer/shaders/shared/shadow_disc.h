// Comparisons over a disc of the world, and how wide that is for a penumbra (Fernando, "Percentage-Closer Soft
// Shadows", SIGGRAPH 2005). Depths of light from a point are lines in 1 / distance, as the width of a penumbra is, seen
// from the light: one formula serves all lights. `atlasWidth`, `atlasHeight`: texels, powers of two.

// Of a disc so far before the receiver that all of it is above its plane.
GNOMON_CONSTANT(kWholeDisc, 1e30f);

// The angle by which a pixel turns the taps, so that their pattern shows as fine noise and not as bands. `weighted`:
// the sum of the pixel's x times kNoiseX and y times kNoiseY. (Jimenez, "Next Generation Post Processing in Call of
// Duty", 2014: interleaved gradient noise.)
GNOMON_CONSTANT(kNoiseX, 0.06711056f);
GNOMON_CONSTANT(kNoiseY, 0.00583715f);

GNOMON_FUNCTION Real noiseTurn(Real weighted) {
  return 6.2831853f * fract(52.9829189f * fract(weighted));
}

// Texels of a length across the light that is not negative.
GNOMON_FUNCTION Real texelsAcross(TileData tile, Real radius, float atlasWidth, float atlasHeight) {
  Real x = tile.atlasPerMetre.x * atlasWidth;
  Real y = tile.atlasPerMetre.y * atlasHeight;
  return radius * max(x, y);
}

// How far a caster may stand off the centre of the texel that shows it, and of the texels that the comparison reads
// around that, across the light.
GNOMON_FUNCTION Real seenAround(TileData tile, float atlasWidth, float atlasHeight) {
  return 2.0f / texelsAcross(tile, Real(1.0f), atlasWidth, atlasHeight);
}

// The radius of the penumbra, a length across the light, for each z between caster and receiver.
GNOMON_FUNCTION float penumbraPerDepth(LightData light, TileData tile, float atlasWidth) {
  return light.filterRadius / (tile.texelDepth * tile.atlasPerMetre.x * atlasWidth);
}

// As far as the search for casters goes, a length across the light: as wide as the penumbra of the nearest one that the
// tile can hold.
GNOMON_FUNCTION Real searchReach(TileData tile, float perDepth, Real depth) {
  return min(perDepth * max(depth, 0.0f), tile.filterReach);
}

// The mean z between the receiver and casters, by their sum and count: of those that stand before the light's disc or,
// where there are none, of all. Negative where there are none either.
GNOMON_FUNCTION Real meanHeight(Real coveringSum, Real coveringCount, Real standingSum, Real standingCount) {
  Real sum = select(coveringCount > 0.0f, coveringSum, standingSum);
  Real count = select(coveringCount > 0.0f, coveringCount, standingCount);
  return select(count > 0.0f, sum / max(count, 1.0f), Real(-1.0f));
}

// The radius of the penumbra for casters of that mean z; negative as that is.
GNOMON_FUNCTION Real radiusOfHeight(float perDepth, Real height, Real reach) {
  return select(height < 0.0f, height, min(perDepth * height, reach));
}
