// The step from what a line of sight meets to a picture: linear light comes in, linear colors of 0..1 go out, which the
// target encodes as sRGB. Shading ends before this step. Layers are put before each other in linear light; only then is
// the result exposed and tone mapped.
//
// The samples of a pixel are averaged after this step. The mean of a lamp's radiance and a wall's is near the lamp's
// own, so if they were averaged before it, tone mapping would make steps of the edges of very bright things. The price
// is one call for each surface that a pixel shows: mostly one.
struct SeenLight {
  vec3 radiance; // is exposed and tone mapped
  vec3 color;    // shows as it is: a background, what is unlit
  Real alpha;
};

GNOMON_FUNCTION SeenLight seenLight(vec3 radiance, vec3 color, Real alpha) {
  SeenLight seen;
  seen.radiance = radiance;
  seen.color = color;
  seen.alpha = alpha;
  return seen;
}

// With a layer before it that sends `radiance` and lets a share `through`.
GNOMON_FUNCTION SeenLight seenBehind(SeenLight seen, vec3 radiance, Real through) {
  return seenLight(radiance + through * seen.radiance, through * seen.color, 1.0f - through * (1.0f - seen.alpha));
}

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

// `tone`: GNOMON_TONE_...
GNOMON_FUNCTION vec3 toneMapped(vec3 radiance, int tone) {
  if (tone == GNOMON_TONE_ACES) return acesToneMapped(radiance);
  if (tone == GNOMON_TONE_CLIP) return clamp(radiance, 0.0f, 1.0f);
  return radiance;
}

GNOMON_FUNCTION vec3 shownColor(SeenLight seen, Real exposure, int tone) {
  return toneMapped(seen.radiance * exposure, tone) + seen.color;
}

GNOMON_FUNCTION Real luminance(vec3 color) {
  return dot(vec3(0.2126f, 0.7152f, 0.0722f), color);
}
