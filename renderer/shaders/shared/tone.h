// From radiance, exposed, to what a picture of 8 bits shows, 0..1 and still linear.

// The ACES reference rendering and output transforms as fitted by Stephen Hill (2016), scaled so that middle grey
// stays.
GNOMON_FUNCTION vec3 acesToneMapped(vec3 radiance) {
  vec3 r = radiance * (1.0f / 0.6f);
  vec3 v = vec3(0.59719f, 0.07600f, 0.02840f) * r.x + vec3(0.35458f, 0.90834f, 0.13383f) * r.y +
           vec3(0.04823f, 0.01566f, 0.83777f) * r.z;
  vec3 a = v * (v + 0.0245786f) - 0.000090537f;
  vec3 b = v * (0.983729f * v + 0.4329510f) + 0.238081f;
  vec3 q = a / b;
  vec3 shown = vec3(1.60475f, -0.10208f, -0.00327f) * q.x + vec3(-0.53108f, 1.10813f, -0.07276f) * q.y +
               vec3(-0.07367f, -0.00605f, 1.07602f) * q.z;
  return clamp(shown, 0.0f, 1.0f);
}

GNOMON_FUNCTION vec3 clippedTone(vec3 radiance) {
  return clamp(radiance, 0.0f, 1.0f);
}
