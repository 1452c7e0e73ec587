// Visibility of a light through its tiles in the shadow atlas.
layout(std430, binding = GNOMON_LIGHT_BUFFER) readonly buffer LightBuffer { LightData lights[]; };
layout(std430, binding = GNOMON_TILE_BUFFER) readonly buffer TileBuffer { TileData tiles[]; };
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2DShadow atlas;

struct Receiver {
  vec3 relative;
  vec3 normal;     // of the surface itself, not of its shading; unit length
  float viewDepth; // metres
};

// Kernels of 3, 5 and 7 bilinear comparisons a side, merged into (size + 1) / 2 lookups a side: the kernel, convolved
// with the bilinear weights, gives size + 1 texel weights; neighbours share a lookup placed at their centre of mass.
// (Castano, "Shadow Mapping Summary", 2013.)
void lookups(int size, float fraction, out vec4 offsets, out vec4 weights) {
  float kernel[9] = float[9](0.0, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  if (size == 5) kernel = float[9](0.0, 1.0, 3.0, 4.0, 3.0, 1.0, 0.0, 0.0, 0.0);
  if (size == 7) kernel = float[9](0.0, 1.0, 5.0, 12.0, 16.0, 12.0, 5.0, 1.0, 0.0);
  for (int i = 0; i < 4; ++i) {
    float low = mix(kernel[2 * i + 1], kernel[2 * i], fraction);
    float high = mix(kernel[2 * i + 2], kernel[2 * i + 1], fraction);
    weights[i] = low + high;
    offsets[i] = weights[i] > 0.0 ? float(2 * i) + high / weights[i] : 0.0;
  }
}

float filtered(vec3 coordinate, int size) {
  if (size <= 1) return textureLod(atlas, coordinate, 0.0);
  vec2 atlasSize = vec2(textureSize(atlas, 0));
  vec2 step = 1.0 / atlasSize; // exact: sides are powers of two
  vec2 texel = coordinate.xy * atlasSize;
  vec2 base = floor(texel - 0.5);
  vec2 fraction = texel - 0.5 - base;
  vec4 offsetsX, offsetsY, weightsX, weightsY;
  lookups(size, fraction.x, offsetsX, weightsX);
  lookups(size, fraction.y, offsetsY, weightsY);
  // The centre of the first texel that the kernel touches.
  vec2 first = base - float(size / 2) + 0.5;
  int count = (size + 1) / 2;
  float sum = 0.0;
  float weight = 0.0;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      float w = weightsX[x] * weightsY[y];
      sum += w * textureLod(atlas, vec3((first + vec2(offsetsX[x], offsetsY[y])) * step, coordinate.z), 0.0);
      weight += w;
    }
  }
  return sum / weight;
}

// Share of the light that one tile lets through; 1 outside of what the tile covers. The bounds leave the filter room:
// no lookup of it leaves the tile.
// The receiver is moved along its normal by reach * sin(angle) (see renderer/shadow/bias.h).
float tileVisibility(TileData tile, Receiver receiver, int filterSize) {
  float cosine = dot(receiver.normal, tile.axis.xyz);
  float offset = tile.interval.w * sqrt(max(1.0 - cosine * cosine, 0.0));
#ifdef PUNCTUAL
  float distance = dot(tile.atlasFromRelative[3], vec4(receiver.relative, 1.0));
  vec4 p = vec4(receiver.relative + receiver.normal * (offset * distance), 1.0);
  float divisor = dot(tile.atlasFromRelative[3], p);
  if (divisor <= 0.0) return 1.0;
  vec3 coordinate = vec3(dot(tile.atlasFromRelative[0], p), dot(tile.atlasFromRelative[1], p),
                         dot(tile.atlasFromRelative[2], p)) / divisor;
  coordinate.z -= tile.bias.x + tile.bias.y / (divisor * divisor);
#else
  vec4 p = vec4(receiver.relative + receiver.normal * offset, 1.0);
  vec3 coordinate = vec3(dot(tile.atlasFromRelative[0], p), dot(tile.atlasFromRelative[1], p),
                         dot(tile.atlasFromRelative[2], p) - tile.bias.x);
#endif
  if (any(lessThan(coordinate.xy, tile.bounds.xy)) || any(greaterThan(coordinate.xy, tile.bounds.zw))) return 1.0;
  return filtered(vec3(coordinate.xy, clamp(coordinate.z, 0.0, 1.0)), filterSize);
}

struct TileChoice {
  int first;   // among the light's tiles
  int second;  // blended in; = first where there is none
  float blend; // share of the second
  float fade;  // share of "lit" at the far end of a manual range
  bool covered;
};

// The first cascade that reaches as far as the view depth.
TileChoice chooseCascade(int light, float viewDepth) {
  int last = int(lights[light].tiles.x) - 1;
  int index = 0;
  vec3 interval = tiles[lights[light].tiles.z].interval.xyz;
  for (int i = 1; i < TILE_COUNT; ++i) {
    if (i <= last && viewDepth > interval.z) {
      index = i;
      interval = tiles[lights[light].tiles.z + i].interval.xyz;
    }
  }
  float zone = interval.z > interval.y ? smoothstep(interval.y, interval.z, viewDepth) : 0.0;
  bool fades = lights[light].cone.w > 0.0;
  if (index < last) return TileChoice(index, zone > 0.0 ? index + 1 : index, zone, 0.0, true);
  return TileChoice(index, index, 0.0, fades ? zone : 0.0, !fades || viewDepth <= interval.z);
}

#ifdef PUNCTUAL
// The face that looks most nearly along the light's way to the point.
TileChoice chooseFace(int light, vec3 toLight) {
  int best = 0;
  float most = -2.0;
  for (int i = 0; i < TILE_COUNT; ++i) {
    float along = -dot(tiles[lights[light].tiles.z + i].axis.xyz, toLight);
    if (i < int(lights[light].tiles.x) && along > most) {
      most = along;
      best = i;
    }
  }
  return TileChoice(best, best, 0.0, 0.0, true);
}
#endif

TileChoice chooseTile(int light, Receiver receiver, vec3 toLight) {
#ifdef PUNCTUAL
  if (int(lights[light].direction.w) != GNOMON_DIRECTIONAL) return chooseFace(light, toLight);
#endif
  return chooseCascade(light, receiver.viewDepth);
}

// `needed` false spares the lookups where no light arrives anyway.
float shadowVisibility(int light, Receiver receiver, vec3 toLight, bool needed) {
#ifdef NO_SHADOWS
  return 1.0;
#endif
  if (lights[light].tiles.x == 0u) return 1.0;
  TileChoice choice = chooseTile(light, receiver, toLight);
  if (!choice.covered) return 1.0;
  float strength = lights[light].cone.z;
#ifdef FILTER_SIZE
  const int size = FILTER_SIZE; // all lights have the same
#else
  int size = int(lights[light].tiles.y);
#endif
  // A face turned away from the light, or along it to within rounding, shadows itself.
  bool turnedAway = dot(receiver.normal, toLight) <= 1e-4;
  float visibility = 0.0;
  for (int i = choice.first; i <= choice.second && needed && !turnedAway; ++i) {
    float share = i == choice.first ? 1.0 - choice.blend : choice.blend;
    visibility += share * tileVisibility(tiles[lights[light].tiles.z + i], receiver, size);
  }
  visibility = mix(visibility, 1.0, choice.fade);
  return mix(1.0, visibility, strength);
}

// Green, blue, purple, red, orange, cyan, yellow, pink: the cascades from near to far, or a light's faces; white beyond.
vec3 cascadeTint(int light, Receiver receiver, vec3 toLight) {
  const vec3 tints[8] = vec3[8](vec3(0.35, 1.0, 0.35), vec3(0.35, 0.5, 1.0), vec3(0.8, 0.35, 1.0), vec3(1.0, 0.3, 0.3),
                                vec3(1.0, 0.65, 0.2), vec3(0.3, 0.95, 0.95), vec3(1.0, 0.95, 0.3), vec3(1.0, 0.5, 0.75));
  TileChoice choice = chooseTile(light, receiver, toLight);
  if (!choice.covered) return vec3(1.0);
  return mix(mix(tints[choice.first], tints[choice.second], choice.blend), vec3(1.0), choice.fade);
}
