// What surfaces reflect of light from all around, summed ahead by roughness: of the studio and of an environment.

// What a surface reflects of light from all around: f0 times the first number plus the second, as reflectedRadiance
// sums up over all directions. Quotients of polynomials, fitted to those integrals: within 0.04 of them where `nv` is
// 0.1 or more, and 0.01 in the mean. `nv`: cosine of the eye's angle to the normal, 0..1.
GNOMON_FUNCTION vec2 sharesOfLobe(Real alpha, Real nv) {
  Real above = 0.1013f + nv * (2.4654f + nv * 7.0021f) + alpha * (6.3101f - nv * 12.1785f) +
               alpha * alpha * (nv * (16.5791f - nv * 8.2453f) - 5.8616f);
  Real below = 1.0f + nv * nv * 8.6305f + alpha * (4.4944f - nv * nv * 11.3974f) +
               alpha * alpha * (nv * (10.4561f + nv * 11.7321f) - 4.8863f);
  Real aboveGrazing = 0.9329f + nv * (nv * 1.3051f - 2.2283f) + alpha * 0.1286f;
  Real belowGrazing = 1.0f + nv * (0.4217f + nv * 13.0785f) + alpha * (13.2793f - nv * 40.179f) +
                      alpha * alpha * (13.7381f + nv * 150.2556f);
  Real grazing = max(aboveGrazing / belowGrazing, 0.0f);
  return vec2(min(above / below, 1.0f - grazing), grazing);
}

// The same by the split-sum fit of Karis, "Physically Based Shading on Mobile", 2014, of another masking term: up to
// 0.25 less.
GNOMON_FUNCTION vec2 splitSum(Real roughness, Real nv) {
  Real rx = roughness * -1.0f + 1.0f;
  Real ry = roughness * -0.0275f + 0.0425f;
  Real a004 = min(rx * rx, exp2(-9.28f * nv)) * rx + ry;
  return vec2(-1.04f * a004 + (roughness * -0.572f + 1.04f), 1.04f * a004 + (roughness * 0.022f + -0.04f));
}

// The share of mirrored light that leaves a surface whose shading normal sends it below the plane of its triangle
// (Russell, "Horizon Occlusion for Normal Mapped Reflections", 2013), which begins a fifth lower here: smooth shading
// alone goes that far at outlines.
GNOMON_FUNCTION Real aboveHorizon(vec3 mirrored, vec3 face) {
  Real shown = clamp(1.26f + 1.3f * dot(mirrored, face), 0.0f, 1.0f);
  return shown * shown;
}

// What comes out after more than one reflection between microfacets, a share of diffuse light: `single` is reflected
// at once by what reflects `f0` at normal incidence, and a share `lost` of white light is not (Fdez-Aguera, "A
// Multiple-Scattering Microfacet Model for Real-Time Image Based Lighting", JCGT 2019).
GNOMON_FUNCTION vec3 reflectedLater(vec3 f0, vec3 single, Real lost) {
  vec3 mean = f0 + (vec3(1.0f) - f0) * (1.0f / 21.0f);
  return lost * single * mean / (vec3(1.0f) - lost * mean);
}

// Shares of diffuse and of mirrored light that a surface sends to the eye. What it gives back of white light where it
// is white is white, whatever its roughness and its metalness: of both materials that are mixed, each by itself.
struct EnvironmentShares {
  vec3 diffuse;
  vec3 mirrored;
};

// `baseColor`, `metallic`: as `s` was made of.
GNOMON_FUNCTION EnvironmentShares environmentShares(SurfacePoint s, vec3 baseColor, Real metallic) {
  vec2 split = sharesOfLobe(s.alpha, clamp(dot(s.normal, s.toEye), 0.0f, 1.0f));
  Real lost = 1.0f - split.x - split.y;
  vec3 dielectricF0 = vec3(0.04f);
  vec3 dielectric = clamp(dielectricF0 * split.x + vec3(split.y), 0.0f, 1.0f);
  vec3 metal = clamp(baseColor * split.x + vec3(split.y), 0.0f, 1.0f);
  vec3 dielectricLater = reflectedLater(dielectricF0, dielectric, lost);
  EnvironmentShares shares;
  shares.diffuse = s.albedo * (vec3(1.0f) - dielectric - dielectricLater) +
                   mix(dielectricLater, reflectedLater(baseColor, metal, lost), metallic);
  shares.mirrored = mix(dielectric, metal, metallic);
  return shares;
}

// The direction that a surface shows as a mirror. Interpolated normals of outlines may turn away from the eye.
GNOMON_FUNCTION vec3 mirroredBy(SurfacePoint s) {
  return s.normal * (2.0f * max(dot(s.normal, s.toEye), 0.0f)) - s.toEye;
}

// The middle of the lobe that a surface shows, `mirrored` as mirroredBy has it: masking turns it to the normal, the
// rougher the more. Of rough metal in a picture with a sun this halves what the mirrored direction alone is off by.
GNOMON_FUNCTION vec3 middleOfLobe(SurfacePoint s, vec3 mirrored) {
  return normalize(mix(mirrored, s.normal, s.alpha * s.alpha));
}

// What a surface shows of `diffuse`, the irradiance over pi on what faces its normal, and of `around`, the mean
// radiance over its lobe about `mirrored`. `face`: the normal of its triangle. `arriving`: what the scene leaves, a
// share of what is diffuse for each of red, green and blue, and one of what is mirrored.
GNOMON_FUNCTION vec3 reflectedAround(SurfacePoint s, vec3 baseColor, Real metallic, vec3 face, vec3 mirrored,
                                     vec3 diffuse, vec3 around, vec4 arriving) {
  EnvironmentShares shares = environmentShares(s, baseColor, metallic);
  return vec3(arriving.x, arriving.y, arriving.z) * shares.diffuse * diffuse +
         arriving.w * aboveHorizon(mirrored, face) * shares.mirrored * around;
}

// What a surface shows of the even studio where `ambient` is 1: Lambert, and the split sum. Light that is reflected
// more than once between microfacets is lost.
GNOMON_FUNCTION vec3 evenStudioReflected(SurfacePoint s, vec4 arriving) {
  Real roughness = sqrt(s.alpha);
  vec2 split = splitSum(roughness, clamp(dot(s.normal, s.toEye), 0.0f, 1.0f));
  vec3 mirrored = reflect(-s.toEye, s.normal);
  vec3 diffuse = s.albedo * irradianceOfEvenStudio(s.normal.y) * vec3(arriving.x, arriving.y, arriving.z);
  return diffuse + (s.f0 * split.x + split.y) * (radianceOfEvenStudio(mirrored.y, roughness) * arriving.w);
}

// What a surface shows of the studio, as reflectedAround has it.
GNOMON_FUNCTION vec3 studioReflected(vec2 turn, uint lamps, SurfacePoint s, vec3 baseColor, Real metallic,
                                     Real roughness, vec3 face, vec4 arriving) {
  if (lamps == 0u) return evenStudioReflected(s, arriving);
  vec3 mirrored = mirroredBy(s);
  vec3 around = vec3(radianceOfLamps(inEnvironment(middleOfLobe(s, mirrored), turn), roughness));
  vec3 diffuse = vec3(irradianceOfLamps(inEnvironment(s.normal, turn)));
  return reflectedAround(s, baseColor, metallic, face, mirrored, diffuse, around, arriving);
}
