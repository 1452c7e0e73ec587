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

// Khronos PBR Neutral (specification of 2024): 0.04, what a smooth dielectric reflects of white surroundings, is taken
// away, and the largest component is compressed from 0.76 on, the color fading to white by 0.15.
GNOMON_FUNCTION vec3 neutralToneMapped(vec3 radiance) {
  Real least = min(radiance.x, min(radiance.y, radiance.z));
  vec3 color = radiance - vec3(select(least < 0.08f, least - 6.25f * least * least, Real(0.04f)));
  Real peak = max(color.x, max(color.y, color.z));
  Real shown = select(peak < 0.76f, peak, 1.0f - 0.0576f / (max(peak, 0.76f) - 0.52f));
  vec3 compressed = color * (shown / max(peak, 1e-10f));
  return clamp(mix(vec3(shown), compressed, 1.0f / (0.15f * (peak - shown) + 1.0f)), 0.0f, 1.0f);
}

// The curve of AgX-S2O3 (Sobotka, 2022) between black, middle grey and white: slope 2 at middle grey, powers 3 below
// and 3.25 above. `place`: the share, 0 to 1, of the 16.5 stops from 10 below middle grey on. Its result is encoded by
// a power of 2.2.
GNOMON_FUNCTION Real agxCurve(Real place) {
  Real above = place - 0.606060606f;
  Real scale = select(above < 0.0f, Real(59.507875f), Real(69.862789f));
  Real power = select(above < 0.0f, Real(3.0f), Real(3.25f));
  Real bent = 1.0f + scale * exp2(power * log2(max(abs(above), 1e-10f)));
  return 0.5f + 2.0f * above * exp2(-log2(bent) / power);
}

GNOMON_FUNCTION Real agxCurveOfLight(Real light) {
  return agxCurve(clamp((log2(max(light, 1e-10f)) + 12.4739312f) * (1.0f / 16.5f), 0.0f, 1.0f));
}

GNOMON_FUNCTION Real agxDecoded(Real encoded) {
  return exp2(2.2f * log2(max(encoded, 1e-10f)));
}

// AgX (Sobotka, 2022) in the primaries of Rec. 2020, with the inset and the outset that Filament has of Blender's, base
// look. The first matrix goes from sRGB's primaries to the inset, the second undoes it, the third goes back to sRGB's.
GNOMON_FUNCTION vec3 agxToneMapped(vec3 radiance) {
  vec3 inset = vec3(0.54481475f, 0.14041695f, 0.08881042f) * radiance.x +
               vec3(0.37378740f, 0.75413756f, 0.17887176f) * radiance.y +
               vec3(0.08139786f, 0.10544550f, 0.73231782f) * radiance.z;
  vec3 bent = vec3(1.12710058f, -0.14132976f, -0.14132976f) * agxCurveOfLight(inset.x) +
              vec3(-0.11060664f, 1.15782370f, -0.11060664f) * agxCurveOfLight(inset.y) +
              vec3(-0.01649394f, -0.01649394f, 1.25193641f) * agxCurveOfLight(inset.z);
  vec3 shown = vec3(1.66049100f, -0.12455048f, -0.01815076f) * agxDecoded(bent.x) +
               vec3(-0.58764114f, 1.13289990f, -0.10057890f) * agxDecoded(bent.y) +
               vec3(-0.07284986f, -0.00834942f, 1.11872966f) * agxDecoded(bent.z);
  return clamp(shown, 0.0f, 1.0f);
}

// `tone`: GNOMON_TONE_...
GNOMON_FUNCTION vec3 toneMapped(vec3 radiance, int tone) {
  if (tone == GNOMON_TONE_ACES) return acesToneMapped(radiance);
  if (tone == GNOMON_TONE_NEUTRAL) return neutralToneMapped(radiance);
  if (tone == GNOMON_TONE_AGX) return agxToneMapped(radiance);
  if (tone == GNOMON_TONE_CLIP) return clamp(radiance, 0.0f, 1.0f);
  return radiance;
}

GNOMON_FUNCTION vec3 shownColor(SeenLight seen, Real exposure, int tone) {
  return toneMapped(seen.radiance * exposure, tone) + seen.color;
}

GNOMON_FUNCTION Real luminance(vec3 color) {
  return dot(vec3(0.2126f, 0.7152f, 0.0722f), color);
}
