// What the scene hides of the environment: a layer a sample of the pixel. rgb: the share of the diffuse light that
// arrives; a: of the mirrored.
#ifdef SKY_SHADOW
layout(binding = GNOMON_SKY_UNIT) uniform sampler2DArray skyShares;

// The mean over `samples` of the pixel, a bit each.
vec4 skyShare(uint samples) {
#if SAMPLES > 1
  vec4 sum = vec4(0.0);
  for (int i = 0; i < SAMPLES; ++i) {
    if ((samples >> uint(i) & 1u) != 0u) sum += texelFetch(skyShares, ivec3(gl_FragCoord.xy, i), 0);
  }
  return sum / float(bitCount(samples));
#else
  return texelFetch(skyShares, ivec3(gl_FragCoord.xy, 0), 0);
#endif
}
#endif
