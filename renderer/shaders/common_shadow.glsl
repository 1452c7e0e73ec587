// Visibility of a light through its tiles in the shadow atlas.
layout(std430, binding = GNOMON_TILE_BUFFER) readonly buffer TileBuffer { TileData tiles[]; };
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2DShadow atlas;

struct Receiver {
  vec3 relative;
  vec3 normal;     // of the surface itself, not of its shading; unit length
  float viewDepth; // metres
};

float compared(TileData tile, vec3 coordinate) {
  return texture(atlas, vec3(clamp(coordinate.xy, tile.bounds.xy, tile.bounds.zw), coordinate.z));
}

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

float filtered(TileData tile, vec3 coordinate, int size) {
  if (size <= 1) return compared(tile, coordinate);
  vec2 atlasSize = vec2(textureSize(atlas, 0));
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
      sum += w * compared(tile, vec3((first + vec2(offsetsX[x], offsetsY[y])) / atlasSize, coordinate.z));
      weight += w;
    }
  }
  return sum / weight;
}

// Share of the light that one tile lets through; 1 outside of what the tile covers.
// The receiver is moved along its normal by reach * sin(angle) (see renderer/shadow/bias.h).
float tileVisibility(uint index, Receiver receiver, vec3 toLight, int filterSize) {
  TileData tile = tiles[index];
  float cosine = clamp(dot(receiver.normal, toLight), 0.0, 1.0);
  float sine = sqrt(1.0 - cosine * cosine);
  vec4 p = vec4(receiver.relative + receiver.normal * (tile.interval.w * sine), 1.0);
  vec3 coordinate = vec3(dot(tile.atlasFromRelative[0], p), dot(tile.atlasFromRelative[1], p),
                         dot(tile.atlasFromRelative[2], p) - tile.bias.x);
  if (any(lessThan(coordinate.xy, tile.bounds.xy)) || any(greaterThan(coordinate.xy, tile.bounds.zw))) return 1.0;
  return filtered(tile, vec3(coordinate.xy, clamp(coordinate.z, 0.0, 1.0)), filterSize);
}

struct CascadeChoice {
  uint first;  // offset into the light's tiles
  uint second; // blended in; = first where there is none
  float blend; // share of the second
  float fade;  // share of "lit" at the far end of a manual range
  bool covered;
};

CascadeChoice chooseCascade(LightData light, float viewDepth) {
  uint last = light.tiles.y - 1u;
  uint index = last;
  for (uint i = 0u; i < last; ++i) {
    if (viewDepth <= tiles[light.tiles.x + i].interval.z) {
      index = i;
      break;
    }
  }
  vec3 interval = tiles[light.tiles.x + index].interval.xyz;
  float zone = interval.z > interval.y ? smoothstep(interval.y, interval.z, viewDepth) : 0.0;
  bool fades = light.cone.w > 0.0;
  bool covered = index < last || !fades || viewDepth <= interval.z;
  if (index == last) return CascadeChoice(index, index, 0.0, fades ? zone : 0.0, covered);
  return CascadeChoice(index, index + 1u, zone, 0.0, covered);
}

float shadowVisibility(LightData light, Receiver receiver, vec3 toLight) {
#ifdef NO_SHADOWS
  return 1.0;
#endif
  if (light.tiles.y == 0u) return 1.0;
  CascadeChoice choice = chooseCascade(light, receiver.viewDepth);
  if (!choice.covered) return 1.0;
  // A face turned away from the light, or along it to within rounding, shadows itself.
  if (dot(receiver.normal, toLight) <= 1e-4) return 1.0 - light.cone.z * (1.0 - choice.fade);
#ifdef FILTER_SIZE
  const int size = FILTER_SIZE; // all lights have the same
#else
  int size = int(light.tiles.z);
#endif
  float visibility = 0.0;
  for (uint i = choice.first; i <= choice.second; ++i) {
    float share = i == choice.first ? 1.0 - choice.blend : choice.blend;
    if (share > 0.0) visibility += share * tileVisibility(light.tiles.x + i, receiver, toLight, size);
  }
  visibility = mix(visibility, 1.0, choice.fade);
  return mix(1.0, visibility, light.cone.z);
}

// Green, blue, purple, red: the cascades from near to far; white beyond.
vec3 cascadeTint(LightData light, float viewDepth) {
  const vec3 tints[4] = vec3[4](vec3(0.35, 1.0, 0.35), vec3(0.35, 0.5, 1.0), vec3(0.8, 0.35, 1.0), vec3(1.0, 0.3, 0.3));
  if (light.tiles.y == 0u) return vec3(1.0);
  CascadeChoice choice = chooseCascade(light, viewDepth);
  if (!choice.covered) return vec3(1.0);
  return mix(mix(tints[min(choice.first, 3u)], tints[min(choice.second, 3u)], choice.blend), vec3(1.0), choice.fade);
}
