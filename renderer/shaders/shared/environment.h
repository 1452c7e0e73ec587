// The light around a scene from a picture of all directions, prefiltered (renderer/environment/prefilter.h). `texels`
// is its atlas. Each device has environmentTexel(texels, place), the mean of the four texels around a place of the
// atlas, and environmentSquare(number), the corner and the side of a square there.

// A world direction in those of the map. `turn`: cosine and sine of the map's turn about the vertical axis.
GNOMON_FUNCTION vec3 inEnvironment(vec3 direction, vec2 turn) {
  return vec3(turn.x * direction.x + turn.y * direction.z, direction.y, turn.x * direction.z - turn.y * direction.x);
}

// `place`: octahedral.
GNOMON_FUNCTION vec3 environmentAt(EnvironmentTexels texels, vec2 place, Real number) {
  vec3 square = environmentSquare(number);
  return environmentTexel(texels, vec2(square.x, square.y) + (place * 0.5f + vec2(0.5f)) * square.z);
}

// Irradiance over pi of what faces a direction of the map.
GNOMON_FUNCTION vec3 environmentIrradiance(EnvironmentTexels texels, vec3 normal) {
  return environmentAt(texels, octahedral(normal), Real(GNOMON_IRRADIANCE_SQUARE));
}

// Mean radiance over a GGX lobe about a direction of the map. `roughness` is perceptual.
GNOMON_FUNCTION vec3 environmentRadiance(EnvironmentTexels texels, vec3 direction, Real roughness) {
  vec2 place = octahedral(direction);
  Real at = clamp(roughness, 0.0f, 1.0f) * float(GNOMON_ENVIRONMENT_LEVELS - 1);
  Real below = min(floor(at), float(GNOMON_ENVIRONMENT_LEVELS - 2));
  return mix(environmentAt(texels, place, below), environmentAt(texels, place, below + 1.0f), at - below);
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
  vec2 split = splitSum(sqrt(s.alpha), clamp(dot(s.normal, s.toEye), 0.0f, 1.0f));
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

// What a surface shows of the environment, where `arriving` of its light arrives: a share of what is diffuse for each
// of red, green and blue, and one of what is mirrored. `face`: the normal of its triangle.
GNOMON_FUNCTION vec3 environmentReflected(EnvironmentTexels texels, vec2 turn, SurfacePoint s, vec3 baseColor,
                                          Real metallic, Real roughness, vec3 face, vec4 arriving) {
  EnvironmentShares shares = environmentShares(s, baseColor, metallic);
  // Interpolated normals of outlines may turn away from the eye.
  vec3 mirrored = s.normal * (2.0f * max(dot(s.normal, s.toEye), 0.0f)) - s.toEye;
  vec3 around = environmentRadiance(texels, inEnvironment(mirrored, turn), roughness);
  vec3 diffuse = environmentIrradiance(texels, inEnvironment(s.normal, turn));
  return vec3(arriving.x, arriving.y, arriving.z) * shares.diffuse * diffuse +
         arriving.w * aboveHorizon(mirrored, face) * shares.mirrored * around;
}
