// The ACES reference rendering and output transforms as fitted by Stephen Hill (2016), scaled so that middle grey stays.
#ifdef TONE_ACES
vec3 toneMapped(vec3 radiance) {
  const mat3 rrtFromSrgb = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
  const mat3 srgbFromOdt =
      mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
  vec3 v = rrtFromSrgb * (radiance / 0.6);
  vec3 a = v * (v + 0.0245786) - 0.000090537;
  vec3 b = v * (0.983729 * v + 0.4329510) + 0.238081;
  return clamp(srgbFromOdt * (a / b), 0.0, 1.0);
}
#elif defined(TONE_CLIP)
vec3 toneMapped(vec3 radiance) { return clamp(radiance, 0.0, 1.0); }
#else
vec3 toneMapped(vec3 radiance) { return radiance; }
#endif
