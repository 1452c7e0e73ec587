// The light around a scene from a picture of all directions, prefiltered (renderer/environment/prefilter.h). `texels`
// is its atlas. Each device has environmentTexel(texels, place), the mean of the four texels around a place of the
// atlas, and environmentSquare(number), the corner and the side of a square there.

// `place`: octahedral.
GNOMON_FUNCTION vec3 environmentAt(EnvironmentTexels texels, vec2 place, Real number) {
  vec3 square = environmentSquare(number);
  return environmentTexel(texels, vec2(square.x, square.y) + (place * 0.5f + vec2(0.5f)) * square.z);
}

// Irradiance over pi of what faces a direction of the map.
GNOMON_FUNCTION vec3 environmentIrradiance(EnvironmentTexels texels, vec3 normal) {
  return environmentAt(texels, octahedral(normal), Real(GNOMON_IRRADIANCE_SQUARE));
}

// Mean radiance over a GGX lobe about a direction of the map. `roughness` is perceptual; lobes are as wide as its
// square, and so are levels mixed.
GNOMON_FUNCTION vec3 environmentRadiance(EnvironmentTexels texels, vec3 direction, Real roughness) {
  vec2 place = octahedral(direction);
  Real at = clamp(roughness, 0.0f, 1.0f) * float(GNOMON_ENVIRONMENT_LEVELS - 1);
  Real below = min(floor(at), float(GNOMON_ENVIRONMENT_LEVELS - 2));
  Real share = (at * at - below * below) / (below * 2.0f + 1.0f);
  return mix(environmentAt(texels, place, below), environmentAt(texels, place, below + 1.0f), share);
}

// What a surface shows of the environment, as reflectedAround has it.
GNOMON_FUNCTION vec3 environmentReflected(EnvironmentTexels texels, vec2 turn, SurfacePoint s, vec3 baseColor,
                                          Real metallic, Real roughness, vec3 face, vec4 arriving) {
  vec3 mirrored = mirroredBy(s);
  vec3 around = environmentRadiance(texels, inEnvironment(middleOfLobe(s, mirrored), turn), roughness);
  vec3 diffuse = environmentIrradiance(texels, inEnvironment(s.normal, turn));
  return reflectedAround(s, baseColor, metallic, face, mirrored, diffuse, around, arriving);
}
