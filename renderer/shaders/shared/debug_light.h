// What debug views show of one light's map.

// How a row of the tile's matrix, divided by the last one, changes where it is `coordinate`: times the divisor.
GNOMON_FUNCTION vec3 rowGradient(TileData tile, int row, Real coordinate) {
  return vec3(tile.atlasFromRelative[row]) - vec3(tile.atlasFromRelative[3]) * coordinate;
}

// Pixels that a point crosses on the picture for each metre that it moves along `way`. `right`, `up`: the frame's,
// divided by the squares of their lengths.
GNOMON_FUNCTION vec2 pixelsAlong(FrameData frame, vec3 right, vec3 up, vec3 relative, Real viewDepth, vec3 way) {
  vec2 moved = vec2(dot(way, right), dot(way, up));
  if (frame.perspective != 0u) {
    vec2 place = vec2(dot(relative, right), dot(relative, up)) / viewDepth;
    moved = (moved - place * dot(way, vec3(frame.forward))) / viewDepth;
  }
  return moved / vec2(frame.pixelStep);
}

// A texel's two edges as they lie on the surface's plane, metres, times `scale`.
struct TexelSides {
  vec3 u;
  vec3 v;
  Real scale; // 0 where the light grazes the surface
};

// `coordinate`: atlas u, v and depth of the surface; `divisor`: of that. An edge e of the texel lies in the plane and
// crosses one texel of its own axis and none of the other. With the gradients U and V of the two and the normal n:
// n e = 0, V e = 0, U e = 1, so that e = (V x n) / (n (U x V)).
GNOMON_FUNCTION TexelSides texelSides(TileData tile, vec3 coordinate, Real divisor, vec3 normal, vec2 atlasTexels) {
  vec3 u = rowGradient(tile, 0, coordinate.x) * (atlasTexels.x / divisor);
  vec3 v = rowGradient(tile, 1, coordinate.y) * (atlasTexels.y / divisor);
  TexelSides sides;
  sides.u = cross(v, normal);
  sides.v = cross(normal, u);
  sides.scale = dot(normal, cross(u, v));
  return sides;
}

// The same, seen on the picture: pixels, times `scale`.
struct TexelEdges {
  vec2 u;
  vec2 v;
  Real scale;
};

// What the edges of a texel have to be divided by.
GNOMON_FUNCTION Real edgeScale(TexelEdges edges) {
  return max(abs(edges.scale), 1e-30f);
}

// The largest extent in pixels of the texel under the point: the greater singular value of its two edges. (Lloyd et
// al., "Logarithmic Perspective Shadow Maps", 2008: the aliasing error m.) At most what 16 bits of an EXR can hold.
GNOMON_FUNCTION Real texelDensity(TexelEdges edges) {
  Real uu = dot(edges.u, edges.u);
  Real vv = dot(edges.v, edges.v);
  Real uv = dot(edges.u, edges.v);
  Real greatest = sqrt(0.5f * (uu + vv + sqrt((uu - vv) * (uu - vv) + 4.0f * uv * uv)));
  return min(greatest / edgeScale(edges), 65504.0f);
}

// Turbo, from 0 to 1 (Mikhailov, "Turbo, An Improved Rainbow Colormap for Visualization", Google 2019), by Du's
// polynomials of fifth degree. sRGB.
GNOMON_FUNCTION vec3 heat(Real at) {
  Real x = clamp(at, 0.0f, 1.0f);
  vec3 c = vec3(59.28637943f, 2.82956604f, 27.34824973f);
  c = c * x + vec3(-152.94239396f, 4.27729857f, -89.90310912f);
  c = c * x + vec3(132.13108234f, -14.18503333f, 110.36276771f);
  c = c * x + vec3(-42.66032258f, 4.84296658f, -60.58204836f);
  c = c * x + vec3(4.61539260f, 2.19418839f, 12.64194608f);
  return clamp(c * x + vec3(0.13572138f, 0.09140261f, 0.10667330f), 0.0f, 1.0f);
}

// Places of densities and of metres on the heat map.
GNOMON_FUNCTION Real heatOfDensity(Real density) {
  return 0.5f + log2(max(density, 1e-30f)) / 8.0f;
}
GNOMON_CONSTANT(kDecades, 0.30103f); // of an octave

GNOMON_FUNCTION Real heatOfMetres(Real metres) {
  return 1.0f + 0.25f * kDecades * log2(max(metres, 1e-9f));
}

// The mean of a wave of squares, -1 and 1, over a pixel that spans `width` of them: the difference over the pixel of
// the wave's integral, a triangle wave.
GNOMON_FUNCTION Real squareWave(Real place, Real width) {
  Real before = 1.0f - abs(2.0f * fract((place - 0.5f * width) * 0.5f) - 1.0f);
  Real after = 1.0f - abs(2.0f * fract((place + 0.5f * width) * 0.5f) - 1.0f);
  return (after - before) / width;
}

// How bright the grid of texels is at a place of the atlas, texels.
GNOMON_FUNCTION Real gridLight(TexelEdges edges, Real x, Real y) {
  Real area = max(abs(edges.u.x * edges.v.y - edges.u.y * edges.v.x), 1e-30f);
  Real texels = abs(edges.scale) / area;
  Real meanX = squareWave(x, max(length(edges.v) * texels, 0.02f));
  Real meanY = squareWave(y, max(length(edges.u) * texels, 0.02f));
  return mix(0.3f, 1.0f, 0.5f + 0.5f * meanX * meanY);
}

// As bright as the scene, but never so dark that the squares can't be told apart.
GNOMON_FUNCTION Real gridGrey(Real brightness) {
  return 0.15f + 0.85f * clamp(brightness, 0.0f, 1.0f);
}

// The bias moves a point off its surface; along the light, back onto it.
GNOMON_FUNCTION vec3 shiftOnSurface(LightData light, TileData tile, vec3 relative, vec3 normal, vec3 toLight) {
  vec3 moved = movedReceiver(light, tile, relative, normal, toLight) - relative;
  return moved - toLight * (dot(normal, moved) / dot(normal, toLight));
}

GNOMON_CONSTANT(kMostPixels, 6e4f); // of footprints: half floats hold no more

// A hue for each count of nodes, far from those of its neighbours: steps of the golden ratio.
GNOMON_FUNCTION Real hueChannel(Real hue, Real turn) {
  return clamp(abs(fract(hue + turn) * 6.0f - 3.0f) - 1.0f, 0.0f, 1.0f);
}
GNOMON_FUNCTION vec3 nodeColor(Real count) {
  Real hue = fract(count * 0.61803399f);
  Real paleness = 0.55f + 0.4f * fract(count * 0.75487767f);
  Real brightness = 0.7f + 0.3f * fract(count * 0.56984029f);
  vec3 full = vec3(hueChannel(hue, Real(0.0f)), hueChannel(hue, Real(2.0f / 3.0f)), hueChannel(hue, Real(1.0f / 3.0f)));
  return mix(vec3(Real(1.0f)), full, paleness) * brightness;
}

// What is in no node's shadow, by the cosine of its normal and the way to the eye.
GNOMON_FUNCTION Real greyWithoutCaster(Real cosine) {
  return 0.25f + 0.35f * abs(cosine);
}
