// Comparisons with the depths of the shadow atlas.
#if ATLAS_SAMPLES > 1
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2DMS atlas;

// Share of a texel's samples that are no nearer to the light. A texel that lies beside the lookup weighs as one under it.
float tapVisibility(vec3 coordinate) {
  ivec2 texel = ivec2(coordinate.xy * vec2(textureSize(atlas)));
  vec4 depths = vec4(texelFetch(atlas, texel, 0).r, texelFetch(atlas, texel, 1).r, texelFetch(atlas, texel, 2).r,
                     texelFetch(atlas, texel, 3).r);
  return dot(step(vec4(coordinate.z), depths), vec4(0.25));
}

float kernelVisibility(vec3 coordinate, int size) {
  vec2 texel = 1.0 / vec2(textureSize(atlas));
  int reach = size / 2;
  float sum = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) sum += tapVisibility(vec3(coordinate.xy + vec2(x, y) * texel, coordinate.z));
  }
  return sum / float(size * size);
}
#else
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2DShadow atlas;

// One comparison, bilinear.
float tapVisibility(vec3 coordinate) { return textureLod(atlas, coordinate, 0.0); }

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

float kernelVisibility(vec3 coordinate, int size) {
  if (size <= 1) return tapVisibility(coordinate);
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
      sum += w * tapVisibility(vec3((first + vec2(offsetsX[x], offsetsY[y])) * step, coordinate.z));
      weight += w;
    }
  }
  return sum / weight;
}
#endif
